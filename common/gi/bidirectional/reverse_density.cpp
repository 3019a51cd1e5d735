#include "common/gi/bidirectional/reverse_density.h"

#include <bit>

namespace ninefold {
namespace {

// cos_x cos_y / (pi d^2) of point i; 0 where a cosine is not positive.
inline float termOf(const Receivers& x, size_t i, const Place& y) {
  const float dx = y.position.x - x.px[i], dy = y.position.y - x.py[i], dz = y.position.z - x.pz[i];
  const float d2 = dx * dx + dy * dy + dz * dz;
  const float cosXd = dx * x.gx[i] + dy * x.gy[i] + dz * x.gz[i];
  const float cosYd = -(dx * y.normal.x + dy * y.normal.y + dz * y.normal.z);
  const bool faces = (cosXd > 0) & (cosYd > 0) & (d2 > 0);
  return faces ? kInvPi * (cosXd / d2) * (cosYd / d2) : 0.0f;
}

// Sum of the terms of sixteen points that see y.
float seenTerms(const Transport& t, const Receivers& x, const Place& y, Vec3 target, size_t first,
                int drawnFrom, RayCounts& rays) {
  float term[kPacket];
#pragma GCC ivdep
  for (size_t lane = 0; lane < kPacket; ++lane) term[lane] = termOf(x, first + lane, y);
  RayPacket packet;
  uint32_t asked = 0, seen = 0;
  for (size_t lane = 0; lane < kPacket; ++lane) {
    const size_t i = first + lane;
    packet.set(lane, x.origin(i), target - x.origin(i), 0, 1);
    if (i >= x.size() || term[lane] <= 0) continue;
    (static_cast<int>(i) == drawnFrom ? seen : asked) |= 1u << lane;
  }
  rays.shadow += static_cast<uint64_t>(std::popcount(asked));
  if (asked != 0) seen |= asked & ~t.tracer.occluded16(packet, asked);
  float sum = 0;
  for (size_t lane = 0; lane < kPacket; ++lane)
    if ((seen >> lane & 1u) != 0) sum += term[lane];
  return sum;
}

Vec3 targetOf(const Transport& t, const Place& y) {
  return t.rayTarget(y.position, y.normal, y.error);
}

}  // namespace

float reverseDensity(const Transport& t, const Receivers& x, const Place& y, int drawnFrom,
                     RayCounts& rays) {
  const Vec3 target = targetOf(t, y);
  float sum = 0;
  for (size_t first = 0; first < x.size(); first += kPacket)
    sum += seenTerms(t, x, y, target, first, drawnFrom, rays);
  return x.size() == 0 ? 0 : sum / static_cast<float>(x.size());
}

float guessReverseDensity(const CameraPoints& camera, const Place& y, int drawnFrom,
                          uint32_t reached) {
  const Receivers& x = camera.points;
  if (x.size() == 0) return 0;
  float mean = 0;
  bool drawnByJudge = drawnFrom == kNone;
  for (size_t j = 0; j < camera.judges(); ++j) {
    const size_t i = camera.judge(j);
    const bool drew = static_cast<int>(i) == drawnFrom;
    drawnByJudge |= drew;
    if (drew || (reached >> j & 1u) != 0)
      mean += termOf(x, i, y) / static_cast<float>(camera.judges());
  }
  if (drawnByJudge) return mean;
  const float own = termOf(x, static_cast<size_t>(drawnFrom), y);
  return mean + (own - mean) / static_cast<float>(x.size());
}

}  // namespace ninefold
