// gltf_skin.h: the joints of glTF skins, in the file's rest pose.
//
// The node of a skinned mesh does not move it, as glTF says: its joints alone do.
// Owner: refers to model and scene.   Threads: one owner.   Errors: throws Error, naming the skin.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "common/scene/scene.h"

namespace tinygltf {
class Model;
}

namespace ninefold {

class GltfSkins {
 public:
  GltfSkins(const tinygltf::Model& model, Scene& scene);
  // Index into scene.skins of the file's skin.
  int use(int skin);

 private:
  Skin read(int skin);
  const DMat4& worldOf(int node);

  const tinygltf::Model* model_;
  Scene* scene_;
  std::vector<int> parents_;                  // of the nodes; -1: none
  std::vector<std::optional<DMat4>> worlds_;  // of the nodes, as far as they were asked for
  std::map<int, int> known_;
};

}  // namespace ninefold
