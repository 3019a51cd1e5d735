#include "common/gi/elements/still_scene.h"

#include <algorithm>

namespace ninefold {
namespace {

bool isElsewhere(const Scene& a, const Scene& b, size_t instance) {
  const Instance &one = a.instances[instance], &other = b.instances[instance];
  return one.toWorld != other.toWorld || a.meshes[static_cast<size_t>(one.mesh)].shape !=
                                             b.meshes[static_cast<size_t>(other.mesh)].shape;
}

}  // namespace

StillScene::StillScene(const Tracer& all, const Scene* begun) : all_(all) {
  if (begun == nullptr) return;
  const Scene& now = all.scene();
  std::vector<bool> moving(now.instances.size());
  for (size_t i = 0; i < moving.size(); ++i) moving[i] = isElsewhere(now, *begun, i);
  if (std::ranges::find(moving, true) != moving.end())
    still_ = std::make_unique<const Tracer>(all, moving);
}

}  // namespace ninefold
