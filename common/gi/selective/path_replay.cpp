#include "common/gi/selective/path_replay.h"

#include <bit>
#include <utility>

#include "common/sampling/hash.h"

namespace ninefold {
namespace {

constexpr float kFar = 1e17f;  // where rays end that meet nothing [m]

template <typename T>
void append(std::vector<T>& to, const std::vector<T>& from, uint32_t first, uint32_t end) {
  to.insert(to.end(), from.begin() + first, from.begin() + end);
}

}  // namespace

PathReplay::PathReplay(std::shared_ptr<const KeptRow> kept, std::shared_ptr<const PathWorld> world,
                       uint32_t randomization)
    : kept_(std::move(kept)),
      changes_(kept_ == nullptr ? nullptr : &world->since(kept_->world)),
      now_(std::make_shared<KeptRow>(KeptRow{std::move(world), randomization, {}, {}, {}})) {
  if (kept_ == nullptr) return;
  now_->paths.reserve(kept_->paths.size());
  now_->points.reserve(kept_->points.size() + kept_->points.size() / 8);
}

uint64_t PathReplay::stampOf(const PhotonStart& start) {
  const Particle& p = start.particle;
  uint64_t stamp = hashWords(p.lamp, p.punctual, start.isOfMinorLamp);
  for (const Vec3& v : {p.origin, p.direction, p.flux})
    for (int c = 0; c < 3; ++c) stamp = hashWords(stamp, std::bit_cast<uint32_t>(v[c]));
  return stamp;
}

bool PathReplay::isAsBefore(const KeptPath& path) const {
  const std::vector<Vec3>& points = kept_->points;
  if (path.pointsEnd == firstPoint_) return true;  // it carries nothing
  if (changes_->solids &&
      changes_->concern(points[firstPoint_], points[firstPoint_] + kFar * wayOutOfMedia()))
    return false;
  for (uint32_t i = firstPoint_; i + 1 < path.pointsEnd; ++i)
    if (changes_->concern(points[i], points[i + 1])) return false;
  return true;
}

bool PathReplay::passOver(bool startsAlike, std::vector<ElementHit>& hits) {
  const KeptPath& path = kept_->paths[next_++];
  const bool isSame = startsAlike && isAsBefore(path);
  if (isSame) {
    append(hits, kept_->hits, firstHit_, path.hitsEnd);
    append(now_->points, kept_->points, firstPoint_, path.pointsEnd);
    close(path.start, hits);
  }
  firstPoint_ = path.pointsEnd, firstHit_ = path.hitsEnd;
  return isSame;
}

Hit PathReplay::trace(const Tracer& tracer, Vec3 origin, Vec3 direction) {
  const Hit hit = TraceRay{}(tracer, origin, direction);
  std::vector<Vec3>& points = now_->points;
  // One point stands for the end of a ray and the start of the next: they are that near, but for
  // slivers.
  const bool goesOn = std::exchange(hasRay_, true);
  if (goesOn && glm::distance(points.back(), origin) <= now_->world->margin())
    points.back() = origin;
  else
    points.push_back(origin);
  points.push_back(origin + (hit ? hit.t : kFar) * direction);
  return hit;
}

void PathReplay::close(uint64_t start, const std::vector<ElementHit>& hits) {
  now_->paths.push_back(
      {start, static_cast<uint32_t>(now_->points.size()), static_cast<uint32_t>(hits.size())});
}

std::shared_ptr<const KeptRow> PathReplay::finish(const std::vector<ElementHit>& hits) {
  now_->hits = hits;
  return now_;
}

}  // namespace ninefold
