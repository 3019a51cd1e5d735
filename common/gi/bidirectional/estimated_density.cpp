#include "common/gi/bidirectional/estimated_density.h"

#include "common/gi/bidirectional/reverse_density.h"

namespace ninefold {
namespace {

constexpr int kFew = 4;  // of M - 1, for a guess

}  // namespace

EstimatedDensity::EstimatedDensity(const Transport& t, std::span<const View> views,
                                   const FrameKey& frame, int k, int shot, RayCounts& rays)
    : t_(t),
      // Where rays start are points of their own, addressed after those of all sets.
      origins_(cameraPoints(t, views, frame, kMostSets + k, shot, rays)),
      others_(cameraPoints(t, views, frame, k, t.settings.cameraPoints - 1, rays)),
      few_(cameraPoints(t, views, frame, k, kFew, rays)) {}

float EstimatedDensity::with(const Receivers& others, const ReversePlace& y,
                             RayCounts& rays) const {
  const auto count = static_cast<float>(others.size());
  return (y.density + count * reverseDensity(t_, others, y.place, kNone, rays)) / (count + 1);
}

}  // namespace ninefold
