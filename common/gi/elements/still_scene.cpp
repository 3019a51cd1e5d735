#include "common/gi/elements/still_scene.h"

#include <algorithm>
#include <cmath>

namespace ninefold {
namespace {

bool isElsewhere(const Scene& a, const Scene& b, size_t instance) {
  const Instance &one = a.instances[instance], &other = b.instances[instance];
  return one.toWorld != other.toWorld || a.meshes[static_cast<size_t>(one.mesh)].shape !=
                                             b.meshes[static_cast<size_t>(other.mesh)].shape;
}

// Lengths and areas stay.
bool isTurned(const DMat3& then, const DMat3& now) {
  constexpr double kRounding = 1e-9;
  const DMat3 turn = now * glm::inverse(then);
  const DMat3 product = glm::transpose(turn) * turn;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row)
      if (!(std::abs(product[column][row] - (row == column ? 1 : 0)) <= kRounding)) return false;
  return glm::determinant(turn) > 0;
}

}  // namespace

StillScene::StillScene(const Tracer& all, const Scene* begun) : all_(all), begun_(begun) {
  if (begun == nullptr) return;
  const Scene& now = all.scene();
  std::vector<bool> moving(now.instances.size());
  for (size_t i = 0; i < moving.size(); ++i) moving[i] = isElsewhere(now, *begun, i);
  if (std::ranges::find(moving, true) != moving.end())
    still_ = std::make_unique<const Tracer>(all, moving);
}

DMat3 StillScene::linearOf(size_t instance) const {
  const DMat3 now(all_.scene().instances[instance].toWorld);
  if (begun_ == nullptr) return now;
  const DMat3 then(begun_->instances[instance].toWorld);
  return then != now && isTurned(then, now) ? then : now;
}

}  // namespace ninefold
