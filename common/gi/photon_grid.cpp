#include "common/gi/photon_grid.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "common/sampling/sampler.h"

namespace ninefold {

PhotonGrid::PhotonGrid(std::vector<Photon> photons, Metres radius)
    : radius_(radius), inverseCell_(0.5 / static_cast<double>(radius)) {
  if (photons.empty()) return;
  mask_ = std::bit_ceil(2 * static_cast<uint32_t>(photons.size())) - 1;
  std::vector<uint32_t> slots(photons.size());
  starts_.assign(static_cast<size_t>(mask_) + 2, 0);
  for (size_t i = 0; i < photons.size(); ++i) {
    const Vec3 p = photons[i].position;
    slots[i] = slotOf(cell(p.x), cell(p.y), cell(p.z));
    ++starts_[slots[i] + 1];
  }
  for (size_t s = 1; s < starts_.size(); ++s) starts_[s] += starts_[s - 1];
  // Counting sort keeps the photons' order inside a slot: sums come out the same on every client.
  std::vector<uint32_t> next(starts_.begin(), starts_.end() - 1);
  photons_.resize(photons.size());
  for (size_t i = 0; i < photons.size(); ++i) photons_[next[slots[i]]++] = photons[i];
}

int64_t PhotonGrid::cell(float coordinate) const {
  const double c = std::floor(static_cast<double>(coordinate) * inverseCell_);
  return static_cast<int64_t>(std::clamp(c, -0x1p62, 0x1p62));
}

uint32_t PhotonGrid::slotOf(int64_t cx, int64_t cy, int64_t cz) const {
  return static_cast<uint32_t>(hashWords(static_cast<uint64_t>(cx), static_cast<uint64_t>(cy),
                                         static_cast<uint64_t>(cz))) &
         mask_;
}

int PhotonGrid::slotsAround(Vec3 x, std::array<uint32_t, 8>& slots) const {
  // A little wider than r: the distance test below works with rounded positions.
  const float reach = radius_ * 1.0001f;
  const int64_t x0 = cell(x.x - reach), x1 = cell(x.x + reach);
  const int64_t y0 = cell(x.y - reach), y1 = cell(x.y + reach);
  const int64_t z0 = cell(x.z - reach), z1 = cell(x.z + reach);
  int count = 0;
  for (int64_t cz = z0; cz <= z1; ++cz)
    for (int64_t cy = y0; cy <= y1; ++cy)
      for (int64_t cx = x0; cx <= x1; ++cx)
        if (count < 8) slots[static_cast<size_t>(count++)] = slotOf(cx, cy, cz);
  std::sort(slots.begin(), slots.begin() + count);
  return static_cast<int>(std::unique(slots.begin(), slots.begin() + count) - slots.begin());
}

}  // namespace ninefold
