#include "common/gi/bidirectional/tournament.h"

#include <algorithm>
#include <cmath>

#include "common/sampling/sampler.h"

namespace ninefold {
namespace {

constexpr int kCellBits = 10;             // along an axis
constexpr float kCellsInRadius = 256;     // 1024 cells reach from -2 R to 2 R
constexpr int kCodeBits = 3 * kCellBits;  // of a cell

// The cell's coordinates, bit by bit in turn: cells with the same first 3 n bits are of the same
// cell n levels below the whole.
uint32_t cellOf(Vec3 position, Metres radius) {
  uint32_t code = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const float at = kCellsInRadius * (position[axis] / radius + 2);
    const auto cell = static_cast<uint32_t>(std::clamp(at, 0.0f, 1023.0f));
    for (int bit = 0; bit < kCellBits; ++bit) code |= (cell >> bit & 1u) << (3 * bit + axis);
  }
  return code;
}

// A candidate that is neither kept nor dropped yet.
struct Open {
  uint32_t index;
  double p;
};

class Duels {
 public:
  Duels(std::span<const Contender> all, Metres radius, uint64_t key) : all_(all), key_(key) {
    for (uint32_t i = 0; i < all.size(); ++i)
      places_.push_back({cellOf(all[i].position, radius), i});
    std::sort(places_.begin(), places_.end());
  }

  std::vector<uint32_t> kept() {
    const Open last = play(0, places_.size(), kCodeBits - 1);
    if (last.p > 0.5) kept_.push_back(last.index);  // 0 or 1, up to rounding
    std::sort(kept_.begin(), kept_.end());
    return kept_;
  }

 private:
  struct Place {
    uint32_t cell, index;
    auto operator<=>(const Place&) const = default;
  };

  Open openAt(size_t i) const { return {places_[i].index, all_[places_[i].index].p}; }

  // Of those from `first` to before `last`, whose cells differ in no bit above `bit`.
  Open play(size_t first, size_t last, int bit) {
    if (last - first == 1) return openAt(first);
    if (bit < 0) return playInTurn(first, last);
    const auto begin = places_.begin();
    const auto middle = std::partition_point(
        begin + static_cast<ptrdiff_t>(first), begin + static_cast<ptrdiff_t>(last),
        [&](const Place& place) { return (place.cell >> bit & 1u) == 0; });
    const auto half = static_cast<size_t>(middle - begin);
    if (half == first || half == last) return play(first, last, bit - 1);
    const Open a = play(first, half, bit - 1), b = play(half, last, bit - 1);
    return duel(a, b, hashWords(key_, places_[first].cell >> bit, static_cast<uint64_t>(bit)));
  }

  // All are of the same smallest cell.
  Open playInTurn(size_t first, size_t last) {
    Open open = openAt(first);
    for (size_t i = first + 1; i < last; ++i)
      open = duel(open, openAt(i), hashWords(key_, places_[first].cell, kCodeBits + i - first));
    return open;
  }

  Open duel(const Open& a, const Open& b, uint64_t random) {
    const double u = double{unitFloat(static_cast<uint32_t>(random))}, sum = a.p + b.p;
    if (sum < 1) return {u * sum < a.p ? a.index : b.index, sum};
    const bool keepsA = u * (2 - sum) < 1 - b.p;
    kept_.push_back(keepsA ? a.index : b.index);
    return {keepsA ? b.index : a.index, sum - 1};
  }

  const std::span<const Contender> all_;
  const uint64_t key_;
  std::vector<Place> places_;
  std::vector<uint32_t> kept_;
};

}  // namespace

std::vector<uint32_t> tournament(std::span<const Contender> all, Metres radius, uint64_t key) {
  if (all.empty()) return {};
  return Duels(all, radius, key).kept();
}

}  // namespace ninefold
