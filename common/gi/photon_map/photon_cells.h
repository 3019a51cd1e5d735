// photon_cells.h: photons in a hashed grid that takes insertions and deletions, searched by growing
// shells of cells.
//
//   shell k   cells whose number differs from that of x's cell by k along some axis, and by no more
//             along the others
//   no photon in shell k is nearer than (k - 1) h + f,   f: from x to the next face of its own cell
//
// A cell's photons are blocks of sixteen, planar, in a list; a table by cell number has the first
// block of each cell that holds any. The cell size h is chosen for the photons that the grid is
// built of, so that an occupied cell has about kWanted; those that come later do not change it. It
// decides about time alone.
//
// Source:  what Jozwowski 2002, 6, asks for in place of balancing; the structure was made for this
//          project.
// Proved:  tests/gi/photon_search_test.cpp (the same neighbours as photon_tree.h and brute force,
//          after insertions and deletions, too).
// Threads: const functions are reentrant.   Errors: none; an empty grid finds nothing.
#pragma once

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "common/gi/photon_map/nearest.h"

namespace ninefold {

class PhotonCells {
 public:
  PhotonCells() = default;
  explicit PhotonCells(std::span<const NamedPoint> points);

  size_t size() const { return size_; }
  void insert(const NamedPoint& point);
  // One that is there, by the same position and name.
  void erase(const NamedPoint& point);

  // As PhotonTree::near.
  template <typename Visit>
  void near(Vec3 x, float r2, Visit&& visit) const {
    if (size_ == 0) return;
    const std::array<int, 3> c{cell(x, 0), cell(x, 1), cell(x, 2)};
    const float toFace = distanceToFace(x, c);
    const int last = lastShell(c);
    for (int k = 0; k <= last; ++k) {
      const float away = k == 0 ? 0.0f : static_cast<float>(k - 1) * h_ + toFace;
      if (away * away > r2) return;
      const auto each = [&](uint32_t block) { r2 = visitCell(block, x, r2, visit); };
      if (24.0 * k * k > static_cast<double>(cells_.size())) return forAllFrom(c, k, each);
      forShell(c, k, each);
    }
  }

 private:
  static constexpr float kWanted = 12;
  static constexpr float kSlack = 1e-3f;      // [h] rounding may put a point into the next cell
  static constexpr int kMostCells = 1 << 20;  // along an axis
  static constexpr uint32_t kNone = ~0u;
  static constexpr size_t kLanes = 16;
  struct Block {
    std::array<float, kLanes> x{}, y{}, z{};
    std::array<uint32_t, kLanes> name{};
    uint32_t count = 0, next = kNone;
  };
  struct Cell {
    uint64_t key = kFree;
    uint32_t first = kNone;
  };
  static constexpr uint64_t kFree = ~uint64_t{0};

  int cell(Vec3 x, int axis) const {
    const double c = std::floor((double(x[axis]) - double(low_[axis])) * inverse_);
    return static_cast<int>(std::clamp(c, 0.0, kMostCells - 1.0));
  }
  // From x to the next face of its cell, a little less; 0 beyond the grid.
  float distanceToFace(Vec3 x, const std::array<int, 3>& c) const {
    double least = 1;  // [h]
    for (int a = 0; a < 3; ++a) {
      const double from = (double(x[a]) - double(low_[a])) * inverse_ - c[static_cast<size_t>(a)];
      least = std::min(least, std::min(from, 1 - from));
    }
    return std::max(static_cast<float>(least) - kSlack, 0.0f) * h_;
  }
  uint64_t keyOf(Vec3 x) const { return packed(cell(x, 0), cell(x, 1), cell(x, 2)); }
  static uint64_t packed(int x, int y, int z) {
    return static_cast<uint64_t>(x) | static_cast<uint64_t>(y) << 20 |
           static_cast<uint64_t>(z) << 40;
  }
  static std::array<int, 3> unpacked(uint64_t key) {
    const auto part = [&](int shift) { return static_cast<int>(key >> shift & (kMostCells - 1)); };
    return {part(0), part(20), part(40)};
  }
  static uint64_t hashed(uint64_t key) {
    key *= 0x9e3779b97f4a7c15ull;
    return key ^ key >> 32;
  }
  uint32_t blockOf(uint64_t key) const {
    for (size_t at = hashed(key) & mask_;; at = (at + 1) & mask_) {
      if (cells_[at].key == key) return cells_[at].first;
      if (cells_[at].key == kFree) return kNone;
    }
  }
  // Beyond it there are no cells with photons.
  int lastShell(const std::array<int, 3>& c) const {
    int last = 0;
    for (size_t a = 0; a < 3; ++a) last = std::max(last, std::max(c[a] - from_[a], to_[a] - c[a]));
    return last;
  }
  template <typename Do>
  void forRow(int x0, int x1, int step, int y, int z, const Do& each) const {
    for (int x = x0; x <= x1; x += step) {
      if (x < from_[0] || x > to_[0]) continue;
      const uint32_t block = blockOf(packed(x, y, z));
      if (block != kNone) each(block);
    }
  }
  template <typename Do>
  void forShell(const std::array<int, 3>& c, int k, const Do& each) const {
    const int z0 = std::max(c[2] - k, from_[2]), z1 = std::min(c[2] + k, to_[2]);
    const int y0 = std::max(c[1] - k, from_[1]), y1 = std::min(c[1] + k, to_[1]);
    const int x0 = std::max(c[0] - k, from_[0]), x1 = std::min(c[0] + k, to_[0]);
    for (int z = z0; z <= z1; ++z)
      for (int y = y0; y <= y1; ++y) {
        const bool whole = std::abs(z - c[2]) == k || std::abs(y - c[1]) == k;
        if (whole)
          forRow(x0, x1, 1, y, z, each);
        else
          forRow(c[0] - k, c[0] + k, std::max(2 * k, 1), y, z, each);
      }
  }
  // All cells with photons in shell k and beyond, where that is less work than the shell alone.
  template <typename Do>
  void forAllFrom(const std::array<int, 3>& c, int k, const Do& each) const {
    for (const Cell& cell : cells_) {
      if (cell.first == kNone) continue;
      const std::array<int, 3> at = unpacked(cell.key);
      const int away = std::max(std::max(std::abs(at[0] - c[0]), std::abs(at[1] - c[1])),
                                std::abs(at[2] - c[2]));
      if (away >= k) each(cell.first);
    }
  }
  template <typename Visit>
  float visitCell(uint32_t block, Vec3 x, float r2, Visit&& visit) const {
    for (; block != kNone; block = blocks_[block].next) {
      const Block& b = blocks_[block];
      std::array<float, kLanes> d2;
#pragma GCC ivdep
      for (size_t i = 0; i < kLanes; ++i) {
        const float dx = b.x[i] - x.x, dy = b.y[i] - x.y, dz = b.z[i] - x.z;
        d2[i] = dx * dx + dy * dy + dz * dz;
      }
      for (size_t i = 0; i < b.count; ++i)
        if (d2[i] <= r2) r2 = visit(d2[i], b.name[i]);
    }
    return r2;
  }

  void place(std::span<const NamedPoint> points, Vec3 low, Vec3 high, float h);
  Cell& cellFor(uint64_t key);
  void grow();
  uint32_t newBlock(uint32_t next);

  std::vector<Cell> cells_;  // open addressing, at most half full
  std::vector<Block> blocks_;
  std::vector<uint32_t> spare_;  // blocks that are empty
  size_t size_ = 0, used_ = 0;   // photons; cells of the table
  uint64_t mask_ = 0;
  Vec3 low_{0};
  std::array<int, 3> from_{}, to_{};  // all cells with photons lie between
  float h_ = 1;                       // [m]
  double inverse_ = 1;                // 1/h
};

}  // namespace ninefold
