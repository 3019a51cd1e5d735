// gltf_skin.h: the joints of glTF skins, in the file's rest pose.
//
//   M_i = world(joint_i) inverseBind_i        takes vertices of a mesh to where joint i holds them
//
// The node of a skinned mesh does not move it, as glTF says: its joints alone do.
// Owner: refers to the model.   Threads: one owner.   Errors: throws Error, naming the skin.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "common/math/vec.h"

namespace tinygltf {
class Model;
}

namespace ninefold {

// World places are relative to the first joint's, so that vertices far from the file's origin
// lose nothing when they become floats.
struct SkinPose {
  DVec3 place{0};
  std::vector<DMat4> joints;  // translate(-place) M_i; at least one
};

class GltfSkins {
 public:
  explicit GltfSkins(const tinygltf::Model& model);
  const SkinPose& pose(int skin);

 private:
  SkinPose read(int skin);
  const DMat4& worldOf(int node);

  const tinygltf::Model* model_;
  std::vector<int> parents_;                  // of the nodes; -1: none
  std::vector<std::optional<DMat4>> worlds_;  // of the nodes, as far as they were asked for
  std::map<int, SkinPose> poses_;
};

}  // namespace ninefold
