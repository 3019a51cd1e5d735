#include "common/gi/photons/photon_grid.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "common/sampling/sampler.h"

namespace ninefold {

namespace {

// The distance test works with rounded positions, so a query reaches a little further than r; and
// what it covers must not be wider than a cell.
constexpr double kReach = 1.0001, kHalfCell = 1.0002;  // [r]

}  // namespace

PhotonGrid::PhotonGrid(std::vector<Photon> photons, Metres radius)
    : radius_(std::max(radius, kMinRadius)),
      inverseCell_(0.5 / (kHalfCell * static_cast<double>(radius_))) {
  if (photons.empty()) return;
  low_ = high_ = photons.front().position;
  for (const Photon& photon : photons) {
    low_ = glm::min(low_, photon.position), high_ = glm::max(high_, photon.position);
  }
  const float reach = static_cast<float>(kHalfCell) * radius_;
  low_ = low_ - reach, high_ = high_ + reach;
  mask_ = std::bit_ceil(2 * static_cast<uint32_t>(photons.size())) - 1;
  std::vector<uint32_t> slots(photons.size());
  starts_.assign(static_cast<size_t>(mask_) + 2, 0);
  for (size_t i = 0; i < photons.size(); ++i) {
    const Vec3 p = photons[i].position;
    slots[i] = slotOf(cell(double(p.x)), cell(double(p.y)), cell(double(p.z)));
    ++starts_[slots[i] + 1];
  }
  for (size_t s = 1; s < starts_.size(); ++s) starts_[s] += starts_[s - 1];
  // Counting sort keeps the photons' order inside a slot: sums come out the same on every client.
  std::vector<uint32_t> next(starts_.begin(), starts_.end() - 1);
  photons_.resize(photons.size());
  for (size_t i = 0; i < photons.size(); ++i) photons_[next[slots[i]]++] = photons[i];
}

int64_t PhotonGrid::cell(double coordinate) const {
  const double c = std::floor(coordinate * inverseCell_);
  return static_cast<int64_t>(std::clamp(c, -0x1p62, 0x1p62));
}

uint32_t PhotonGrid::slotOf(int64_t cx, int64_t cy, int64_t cz) const {
  // A linear form keeps neighbours apart; the mixing spreads them over the table.
  const uint64_t form = static_cast<uint64_t>(cx) * 0x9e3779b97f4a7c15u +
                        static_cast<uint64_t>(cy) * 0xc2b2ae3d27d4eb4fu +
                        static_cast<uint64_t>(cz) * 0x165667b19e3779f9u;
  return static_cast<uint32_t>(mixWord(form)) & mask_;
}

int PhotonGrid::slotsAround(Vec3 low, Vec3 high, Slots& slots) const {
  const double reach = kReach * static_cast<double>(radius_);
  const DVec3 from = DVec3(low) - reach, to = DVec3(high) + reach;
  // Where rounding is larger than a cell, even a point's sphere seems to cover many.
  const bool point = low == high;
  const auto end = [&](double last, int64_t first) {
    return point ? std::min(cell(last), first + 2) : cell(last);
  };
  const int64_t x0 = cell(from.x), x1 = end(to.x, x0);
  const int64_t y0 = cell(from.y), y1 = end(to.y, y0);
  const int64_t z0 = cell(from.z), z1 = end(to.z, z0);
  const auto cells = [](int64_t first, int64_t last) {
    return static_cast<double>(last) - static_cast<double>(first) + 1;
  };
  if (cells(x0, x1) * cells(y0, y1) * cells(z0, z1) > kMostCells) return -1;
  int count = 0;
  for (int64_t cz = z0; cz <= z1; ++cz)
    for (int64_t cy = y0; cy <= y1; ++cy)
      for (int64_t cx = x0; cx <= x1; ++cx) {
        const uint32_t slot = slotOf(cx, cy, cz);
        if (starts_[slot] != starts_[slot + 1]) slots[static_cast<size_t>(count++)] = slot;
      }
  std::sort(slots.begin(), slots.begin() + count);
  return static_cast<int>(std::unique(slots.begin(), slots.begin() + count) - slots.begin());
}

}  // namespace ninefold
