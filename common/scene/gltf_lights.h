// gltf_lights.h: the lamps of a glTF file: KHR_lights_punctual, and those with a measured profile
// (gltf_profiles.h). A lamp shines along its node's -Z.
// Owner: refers to file, folder and draft.   Threads: one.
// Errors: throws Error, naming the light.
#pragma once

#include "common/scene/gltf_profiles.h"
#include "common/scene/light_units.h"
#include "common/scene/scene_draft.h"

namespace tinygltf {
class Model;
class Node;
}  // namespace tinygltf

namespace ninefold {

class GltfLights {
 public:
  GltfLights(const GltfFile& file, const SceneFolder& folder, SceneDraft& draft);

  // Appends the lamps of a node.
  void add(const tinygltf::Node& node, const DMat4& toWorld);
  // Brings all lamps to W/sr and W/m^2 together, as one file has one unit, and says so in the log.
  void applyUnits(LightUnits units);

 private:
  void addPunctual(const tinygltf::Node& node, int index, const DMat4& toWorld);
  void addProfiled(const tinygltf::Node& node, const tinygltf::Value& use, const DMat4& toWorld);
  void keep(PunctualLight light, const DMat4& toWorld);

  const tinygltf::Model* model_;
  SceneDraft* draft_;
  GltfProfiles profiles_;
};

}  // namespace ninefold
