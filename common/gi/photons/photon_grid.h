// photon_grid.h: photons in a hashed grid of cells a hair wider than 2r. A sphere of radius r meets
// at most eight cells (27 where rounding is as large as r), and a cell's photons lie side by side.
// Queries are for boxes of points that lie together: cells are looked up once for all. The grid
// knows nothing of light: items are (position, index).
//
// Cells are hashed into a table of twice the photon count (a power of two). Two cells that collide
// share a slot. A query visits each slot once, so nothing is met twice, and the distance test
// rejects strangers. Cells are numbered by 64-bit integers, floor(position / 2r): any coordinates
// are safe while |position| / 2r < 2^62. A radius below kMinRadius counts as kMinRadius: r^2, by
// which flux is divided, stays a normal float.
//
// Source:  Teschner et al. 2003 (spatial hashing).   Proved: tests/gi (against brute force).
// Threads: const after build.   Errors: none; an empty grid finds nothing.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/math/units.h"

namespace ninefold {

struct Photon {
  Vec3 position{0};
  Vec3 normal{0};         // geometric, on the side where it landed
  Flux flux{0};           // [W]
  int diffuseBefore = 0;  // D vertices of its path before it landed
};

class PhotonGrid {
 public:
  static constexpr Metres kMinRadius = 1e-15f;

  PhotonGrid() = default;
  // Takes the photons and sorts them by cell. radius > 0.
  PhotonGrid(std::vector<Photon> photons, Metres radius);

  bool empty() const { return photons_.empty(); }
  size_t size() const { return photons_.size(); }
  Metres radius() const { return radius_; }
  std::span<const Photon> photons() const { return photons_; }

  // Calls visit(const Photon&) in a fixed order for each photon within the radius of the box
  // [low, high], and perhaps for some a little further. False, and nothing visited, if the box
  // covers too many cells: halve it. A point is never too large.
  template <typename Visit>
  bool near(Vec3 low, Vec3 high, Visit&& visit) const {
    if (photons_.empty() || glm::any(glm::lessThan(high, low_)) ||
        glm::any(glm::greaterThan(low, high_)))
      return true;
    if (photons_.size() <= kFew) {
      visitNear(photons_, low, high, visit);
      return true;
    }
    Slots slots;
    const int count = slotsAround(low, high, slots);
    if (count < 0) return false;
    for (int s = 0; s < count; ++s) {
      const uint32_t slot = slots[static_cast<size_t>(s)];
      visitNear(std::span(photons_).subspan(starts_[slot], starts_[slot + 1] - starts_[slot]), low,
                high, visit);
    }
    return true;
  }

 private:
  static constexpr size_t kFew = 64;  // so many are looked at sooner than their cells are found
  static constexpr int kMostCells = 64;
  template <typename Visit>
  void visitNear(std::span<const Photon> some, Vec3 low, Vec3 high, const Visit& visit) const {
    const float r2 = radius_ * radius_;
    for (const Photon& photon : some) {
      const Vec3 off = photon.position - glm::clamp(photon.position, low, high);
      if (glm::dot(off, off) <= r2) visit(photon);
    }
  }
  using Slots = std::array<uint32_t, kMostCells>;
  // Those with photons, sorted; returns how many, -1 if there are more cells than kMostCells.
  int slotsAround(Vec3 low, Vec3 high, Slots& slots) const;
  uint32_t slotOf(int64_t cx, int64_t cy, int64_t cz) const;
  int64_t cell(double coordinate) const;

  std::vector<Photon> photons_;   // by slot
  std::vector<uint32_t> starts_;  // first photon of each slot, and the end
  Vec3 low_{0}, high_{0};         // box around all spheres
  Metres radius_ = 0;
  double inverseCell_ = 0;
  uint32_t mask_ = 0;
};

}  // namespace ninefold
