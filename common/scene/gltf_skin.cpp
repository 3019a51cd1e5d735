#include "common/scene/gltf_skin.h"

#include <tiny_gltf.h>

#include "common/base/error.h"
#include "common/scene/gltf_accessor.h"
#include "common/scene/gltf_transform.h"

namespace ninefold {

GltfSkins::GltfSkins(const tinygltf::Model& model, Scene& scene)
    : model_(&model),
      scene_(&scene),
      parents_(model.nodes.size(), -1),
      worlds_(model.nodes.size()) {
  for (size_t i = 0; i < model.nodes.size(); ++i)
    for (const int child : model.nodes[i].children)
      if (child >= 0 && static_cast<size_t>(child) < parents_.size())
        parents_[static_cast<size_t>(child)] = static_cast<int>(i);
}

int GltfSkins::use(int skin) {
  if (const auto known = known_.find(skin); known != known_.end()) return known->second;
  if (skin < 0 || static_cast<size_t>(skin) >= model_->skins.size())
    fail("skin {} does not exist", skin);
  try {
    scene_->skins.push_back(read(skin));
    return known_[skin] = static_cast<int>(scene_->skins.size()) - 1;
  } catch (const Error& e) {
    fail("skin {} '{}': {}", skin, model_->skins[static_cast<size_t>(skin)].name, e.what());
  }
}

Skin GltfSkins::read(int skin) {
  const tinygltf::Skin& from = model_->skins[static_cast<size_t>(skin)];
  if (from.joints.empty()) fail("it has no joints");
  std::optional<GltfAccessor> inverseBind;
  if (from.inverseBindMatrices >= 0)
    inverseBind.emplace(*model_, from.inverseBindMatrices, 16, "inverseBindMatrices");
  if (inverseBind && inverseBind->count() < from.joints.size())
    fail("{} inverseBindMatrices for {} joints", inverseBind->count(), from.joints.size());
  Skin read;
  read.place = DVec3(worldOf(from.joints[0])[3]);
  for (size_t i = 0; i < from.joints.size(); ++i)
    read.joints.push_back({from.joints[i], -1, worldOf(from.joints[i]),
                           inverseBind ? inverseBind->matrix(i) : DMat4(1)});
  return read;
}

// Climbs to the nearest node whose world matrix is known, or to a root, and comes down again.
const DMat4& GltfSkins::worldOf(int node) {
  if (node < 0 || static_cast<size_t>(node) >= parents_.size())
    fail("node {} does not exist", node);
  std::vector<size_t> climbed;
  for (int at = node; at >= 0 && !worlds_[static_cast<size_t>(at)];
       at = parents_[static_cast<size_t>(at)]) {
    if (climbed.size() > parents_.size()) fail("node {} has a cycle above it", node);
    climbed.push_back(static_cast<size_t>(at));
  }
  for (auto at = climbed.rbegin(); at != climbed.rend(); ++at) {
    const int parent = parents_[*at];
    const DMat4 above = parent < 0 ? DMat4(1) : *worlds_[static_cast<size_t>(parent)];
    worlds_[*at] = above * localMatrix(model_->nodes[*at]);
  }
  return *worlds_[static_cast<size_t>(node)];
}

}  // namespace ninefold
