#include "common/gi/photon_map/map_gather.h"

#include <numeric>
#include <span>

#include "common/sampling/sampler.h"

namespace ninefold {
namespace {

constexpr size_t kGroup = 32;
constexpr float kAligned = 0.98f;          // cosine between normals of a group
constexpr float kCandidateCosine = 0.25f;  // least that any of the group accepts: 60 + 11.5 degrees
constexpr float kRounding = 1.0001f;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// What one receiver found. r < 0: it must search alone.
struct Found {
  Metres r = -1;
  Flux flux{0};
};

class Gathering {
 public:
  Gathering(const Transport& t, const PhotonPool& pool, int pathVertices, uint32_t randomization,
            MapGatherScratch& scratch, Receivers& receivers, RayCounts& rays)
      : t_(t),
        pool_(pool),
        pathVertices_(pathVertices),
        turnKey_(
            hashWords(t.settings.seed, static_cast<uint64_t>(SampleUse::mapPhoton), randomization)),
        s_(scratch),
        x_(receivers),
        rays_(rays),
        farthest_(t.settings.mapDistance * t.radius),
        height_(farthest_ / 8),
        m_(static_cast<size_t>(t.settings.mapNearest)) {}

  // Receivers by index; put into another order.
  void group(std::span<uint32_t> some) {
    if (some.size() > kGroup) return halves(some);
    const uint32_t middle = middleOf(some);
    const Vec3 centre = x_.position(middle), n = x_.ng(middle);
    float spread = 0;
    bool together = true;
    for (const uint32_t i : some) {
      spread = std::max(spread, glm::length(x_.position(i) - centre));
      together &= glm::dot(x_.ng(i), n) >= kAligned;
    }
    const bool isOne = some.size() == 1;
    if (!isOne && (!together || spread > farthest_ / 4)) return halves(some);
    const float r = searchFrom(centre, n);
    if (!isOne && spread > r / 2) return halves(some);
    const float reach = kRounding * std::min(r + 2 * spread, farthest_ + spread);
    collect(centre, n, reach);
    Found found[kGroup];
    for (size_t j = 0; j < some.size(); ++j) {
      const float away = kRounding * glm::length(x_.position(some[j]) - centre);
      found[j] = select(some[j], isOne ? kInfinity : reach - away);
    }
    add(some, middle, spread, found);
    for (size_t j = 0; j < some.size(); ++j)
      if (found[j].r < 0) group(some.subspan(j, 1));
  }

 private:
  // The receiver nearest to the middle of their box.
  uint32_t middleOf(std::span<const uint32_t> some) const {
    const auto [low, high] = boxOf(some);
    const Vec3 middle = 0.5f * (low + high);
    return *std::min_element(some.begin(), some.end(), [&](uint32_t a, uint32_t b) {
      return squaredDistance(x_.position(a), middle) < squaredDistance(x_.position(b), middle);
    });
  }

  std::pair<Vec3, Vec3> boxOf(std::span<const uint32_t> some) const {
    Vec3 low = x_.position(some[0]), high = low;
    for (const uint32_t i : some) {
      low = glm::min(low, x_.position(i));
      high = glm::max(high, x_.position(i));
    }
    return {low, high};
  }

  // One after the other, cut across the longest side.
  void halves(std::span<uint32_t> some) {
    const auto [low, high] = boxOf(some);
    const Vec3 size = high - low;
    const std::vector<float>& along =
        size.x >= size.y ? (size.x >= size.z ? x_.px : x_.pz) : (size.y >= size.z ? x_.py : x_.pz);
    const auto half = some.begin() + static_cast<std::ptrdiff_t>(some.size() / 2);
    std::nth_element(some.begin(), half, some.end(), [&](uint32_t a, uint32_t b) {
      return along[a] < along[b] || (along[a] == along[b] && a < b);
    });
    group(some.first(some.size() / 2));
    group(some.subspan(some.size() / 2));
  }

  bool isAllowed(const MapPhoton& p) const {
    return t_.allows(static_cast<int>(p.diffuseBefore) + pathVertices_);
  }

  // r of a point.
  float searchFrom(Vec3 x, Vec3 n) {
    s_.nearest.begin(m_, farthest_ * farthest_);
    float limit = farthest_ * farthest_;
    pool_.near(x, limit, [&](float d2, uint32_t name) {
      const MapPhoton& p = pool_[name];
      if (glm::dot(p.normal, n) > kMapNormalCosine &&
          std::abs(glm::dot(p.position - x, n)) <= height_ && isAllowed(p))
        limit = s_.nearest.offer(d2, name);
      return limit;
    });
    const float r2 = s_.nearest.farthest2();
    return r2 < 0 ? farthest_ : std::sqrt(r2);
  }

  // All hits within reach of the centre that one of the group may accept.
  void collect(Vec3 centre, Vec3 n, float reach) {
    s_.names.clear();
    pool_.near(centre, reach * reach, [&](float, uint32_t name) {
      const MapPhoton& p = pool_[name];
      if (glm::dot(p.normal, n) > kCandidateCosine && isAllowed(p)) s_.names.push_back(name);
      return reach * reach;
    });
    std::sort(s_.names.begin(), s_.names.end());
    for (auto* plane : {&s_.px, &s_.py, &s_.pz, &s_.nx, &s_.ny, &s_.nz, &s_.d2})
      plane->resize(s_.names.size());
    s_.flux.resize(s_.names.size());
    for (size_t j = 0; j < s_.names.size(); ++j) {
      const MapPhoton& p = pool_[s_.names[j]];
      s_.px[j] = p.position.x, s_.py[j] = p.position.y, s_.pz[j] = p.position.z;
      s_.nx[j] = p.normal.x, s_.ny[j] = p.normal.y, s_.nz[j] = p.normal.z;
      s_.flux[j] = p.flux;
    }
  }

  // d^2 of the collected hits from receiver i.
  void measure(size_t i) {
    const Vec3 x = x_.position(i), n = x_.ng(i);
    const float most = farthest_ * farthest_;
#pragma GCC ivdep
    for (size_t j = 0; j < s_.names.size(); ++j) {
      const float dx = s_.px[j] - x.x, dy = s_.py[j] - x.y, dz = s_.pz[j] - x.z;
      const float d2 = dx * dx + dy * dy + dz * dz;
      const float cosine = s_.nx[j] * n.x + s_.ny[j] * n.y + s_.nz[j] * n.z;
      const float off = std::abs(dx * n.x + dy * n.y + dz * n.z);
      const bool accepted = (d2 <= most) & (cosine > kMapNormalCosine) & (off <= height_);
      s_.d2[j] = accepted ? d2 : kInfinity;
    }
  }

  // What receiver i finds among the collected hits, which are all within `room` of it.
  Found select(size_t i, float room) {
    measure(i);
    s_.keys.clear();
    for (uint32_t j = 0; j < s_.names.size(); ++j)
      if (s_.d2[j] < kInfinity) s_.keys.push_back(nearKey(s_.d2[j], j));
    NearKey last = ~NearKey{0};
    float r = farthest_;
    if (s_.keys.size() >= m_) {
      const auto mth = s_.keys.begin() + static_cast<std::ptrdiff_t>(m_) - 1;
      std::nth_element(s_.keys.begin(), mth, s_.keys.end());
      last = *mth;
      r = std::sqrt(squaredDistance(last));
    }
    if (r > room) return {};
    Found found{r, Flux(0)};
    for (uint32_t j = 0; j < s_.names.size(); ++j)
      if (s_.d2[j] < kInfinity && nearKey(s_.d2[j], j) < last) found.flux += s_.flux[j];
    return found;
  }

  void add(std::span<const uint32_t> some, uint32_t middle, float spread, Found* found) {
    SurfaceCover::Disks disks;
    disks.centre = x_.position(middle), disks.normal = x_.ng(middle);
    disks.spread = spread, disks.height = height_, disks.least = farthest_;
    disks.own = x_.object[middle];
    disks.turned =
        glm::dot(t_.tracer.frontNormal(disks.own, x_.triangle[middle]), disks.normal) < 0;
    disks.turn = unitFloat(static_cast<uint32_t>(mixWord(turnKey_ + x_.pixel[middle])));
    const float smallest = 1e-6f * farthest_;  // of r: hits in one point are no infinite light
    bool any = false;
    for (size_t j = 0; j < some.size(); ++j) {
      if (found[j].r < 0 || isBlack(found[j].flux)) continue;
      any = true;
      found[j].r = std::max(found[j].r, smallest);
      disks.least = std::min(disks.least, found[j].r);
      disks.most = std::max(disks.most, found[j].r);
    }
    if (!any) return;
    s_.cover.shoot(t_, disks, rays_);
    for (size_t j = 0; j < some.size(); ++j) {
      const Found& f = found[j];
      if (f.r < 0 || isBlack(f.flux)) continue;
      const float share = s_.cover.share(x_.position(some[j]), x_.ng(some[j]), f.r);
      x_.addIrradiance(some[j], 1 / (kPi * f.r * f.r * share) * f.flux);
    }
  }

  const Transport& t_;
  const PhotonPool& pool_;
  const int pathVertices_;
  const uint64_t turnKey_;
  MapGatherScratch& s_;
  Receivers& x_;
  RayCounts& rays_;
  const Metres farthest_, height_;  // D, D/8
  const size_t m_;
};

}  // namespace

void gatherPool(const Transport& t, const PhotonPool& pool, int pathVertices,
                uint32_t randomization, MapGatherScratch& scratch, Receivers& receivers,
                RayCounts& rays) {
  if (pool.photons().empty()) return;
  std::vector<uint32_t>& order = scratch.order;
  order.resize(receivers.size());
  std::iota(order.begin(), order.end(), 0u);
  if (!order.empty())
    Gathering(t, pool, pathVertices, randomization, scratch, receivers, rays).group(order);
}

void gatherPoolAlone(const Transport& t, const PhotonPool& pool, int pathVertices,
                     uint32_t randomization, MapGatherScratch& scratch, Receivers& receivers,
                     RayCounts& rays) {
  if (pool.photons().empty()) return;
  Gathering gathering(t, pool, pathVertices, randomization, scratch, receivers, rays);
  for (uint32_t i = 0; i < receivers.size(); ++i) gathering.group({&i, 1});
}

}  // namespace ninefold
