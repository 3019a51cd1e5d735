// gltf_profiles.h: light profiles of a glTF file (EXT_lights_ies), each read when the first node
// that is used asks for it.
//
//   lights[i]  uri of an .ies file, beneath the scene's folder, or bufferView
//   node       light: i;  multiplier >= 0;  color, linear, held to 0 ... 1
//   I = candela multiplier color
//
// How the file's angles lie in the node: the point of both angles 0, where the lamp aims, is -Z;
// the horizontal plane is X and Y, and the plane of horizontal angle 0 holds X. So vertical angles
// count from -Z, horizontal ones from X towards Y. The node's place and turn count, its scale does
// not; one that mirrors gives the mirror image.
//
// Of each profile a line in the log says its flux, and which share of its lamps' that is. More than
// all of it is a warning: the file contradicts itself.
//
// Source:  EXT_lights_ies of glTF's registry.   Proved: tests/scene/gltf_profiles_test.cpp.
// Owner:   refers to file, folder and scene.   Threads: one.
// Errors:  throws Error, naming the profile.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "common/scene/gltf_file.h"
#include "common/scene/ies_file.h"
#include "common/scene/scene.h"

namespace tinygltf {
class Value;
}

namespace ninefold {

class GltfProfiles {
 public:
  GltfProfiles(const GltfFile& file, const SceneFolder& folder, Scene& scene)
      : file_(&file), folder_(&folder), scene_(&scene) {}

  struct Light {
    int profile = 0;  // index into scene.profiles
    Vec3 intensity{0};
  };
  // `use`: the extension of a node; isMirrored: whether its matrix mirrors.
  Light use(const tinygltf::Value& use, bool isMirrored);

 private:
  struct Known {
    int profile = 0;
    float peak = 0;  // [cd]
  };
  Known known(int light, bool isMirrored);
  IesFile read(int light, const tinygltf::Value& from);
  std::vector<unsigned char> bytes(const tinygltf::Value& from, std::string& name);

  const GltfFile* file_;
  const SceneFolder* folder_;
  Scene* scene_;
  std::map<std::pair<int, bool>, Known> known_;  // by index in the file, and whether mirrored
  uint64_t bytesLeft_ = kMaxProfileBytes;
  size_t valuesLeft_ = kMaxProfileValues;
};

}  // namespace ninefold
