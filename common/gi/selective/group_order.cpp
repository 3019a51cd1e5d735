#include "common/gi/selective/group_order.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <tuple>

#include "common/math/rounding.h"
#include "common/sampling/hash.h"

namespace ninefold {
namespace {

constexpr int64_t kMostVisible = 16;  // V in sixteenths

uint64_t keyOf(const StatePages& pages, const View& view) {
  uint64_t key =
      hashWords(pages.hash(), static_cast<uint64_t>(view.width), static_cast<uint64_t>(view.height),
                std::bit_cast<uint32_t>(view.camera.verticalFov));
  key = hashWords(key, std::bit_cast<uint32_t>(view.camera.orthographicHeight));
  for (const Vec3& v : {view.camera.eye, view.camera.forward, view.camera.up})
    for (int c = 0; c < 3; ++c) key = hashWords(key, std::bit_cast<uint32_t>(v[c]));
  return key;
}

// Whether a point lies in the camera's field, wherever others may hide it.
class Field {
 public:
  explicit Field(const View& view)
      : eye_(view.camera.eye),
        width_(static_cast<float>(view.width)),
        height_(static_cast<float>(view.height)),
        rays_(view.camera, view.width, view.height) {}

  bool has(Vec3 p) const {
    const auto at = rays_.filmPosition(p - eye_);
    return at && at->x >= 0 && at->y >= 0 && at->x <= width_ && at->y <= height_;
  }

 private:
  Vec3 eye_;
  float width_, height_;
  CameraRays rays_;
};

}  // namespace

uint32_t GroupOrder::rowOf(const StatePages& pages, const View& view, const StepKey& step,
                           uint32_t unit) const {
  const uint32_t rank = unit - step.firstUnit;
  if (step.units >= groups_.rows()) return rank % groups_.rows();
  const uint64_t key = keyOf(pages, view);
  const std::lock_guard lock(mutex_);
  if (order_.empty() || key_ != key) order_ = orderOf(pages, view), key_ = key;
  return order_[rank % order_.size()];
}

std::vector<uint32_t> GroupOrder::orderOf(const StatePages& pages, const View& view) const {
  std::vector<uint32_t> order(groups_.rows());
  std::iota(order.begin(), order.end(), 0u);
  if (pages.all().empty()) return order;
  const std::vector<int64_t> visible = visibility(pages, view);
  std::vector<Urgency> pilots, groups;
  std::vector<uint32_t> others;
  for (const uint32_t r : order) {
    const auto header = rows_.header(pages, r);
    const uint32_t version = header ? header->version : 0;
    if (header && header->stamp == stamp_)
      others.push_back(r);
    else if (groups_.hasPilots(r))
      pilots.push_back({0, version, r});
    else
      groups.push_back({visible[r] * GroupPages::priority(pages, r), version, r});
  }
  const auto isBefore = [](const Urgency& a, const Urgency& b) {
    return std::tuple(-a.priority, a.version, a.row) < std::tuple(-b.priority, b.version, b.row);
  };
  std::ranges::sort(pilots, isBefore);
  std::ranges::sort(groups, isBefore);
  order.clear();
  for (size_t i = 0; i < std::max(pilots.size(), groups.size()); ++i) {
    if (i < pilots.size()) order.push_back(pilots[i].row);
    if (i < groups.size()) order.push_back(groups[i].row);
  }
  order.insert(order.end(), others.begin(), others.end());
  return order;
}

std::vector<int64_t> GroupOrder::visibility(const StatePages& pages, const View& view) const {
  const Field field(view);
  const auto isSeen = [&](const ElementHit& hit) {
    if (!surfaces_.isThere(hit.surface)) return false;
    const auto [instance, triangle, isBack] = surfaces_.surfaceOf(hit.surface);
    const Tracer::Corners at = tracer_.corners(instance, triangle);
    return field.has(pointOnTriangle(at.a, at.b, at.c, static_cast<float>(hit.u) / 65535,
                                     static_cast<float>(hit.v) / 65535));
  };
  std::vector<int64_t> seen(groups_.groups(), 0), all(groups_.groups(), 0);
  for (uint32_t r = groups_.groups(); r < groups_.rows(); ++r) {
    const auto row = rows_.read(pages, r);
    if (!row) continue;
    size_t first = 0;
    for (uint32_t k = 0; k < row->pilots.size(); ++k) {
      const size_t end = std::min<size_t>(row->pilots[k].end, row->hits.size());
      const uint32_t alike = groups_.likeGroup(groups_.photon(r, k));
      const auto from = row->hits.begin() + static_cast<std::ptrdiff_t>(std::min(first, end));
      const auto to = row->hits.begin() + static_cast<std::ptrdiff_t>(end);
      ++all[alike];
      if (std::any_of(from, to, isSeen)) ++seen[alike];
      first = end;
    }
  }
  for (size_t g = 0; g < seen.size(); ++g)
    seen[g] = all[g] == 0 ? kMostVisible : std::max<int64_t>(kMostVisible * seen[g] / all[g], 1);
  return seen;
}

}  // namespace ninefold
