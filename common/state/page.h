// page.h: what a method's state is made of: named pages of at most 64 KiB, in two forms.
//
//   records   bytes. A change replaces the page whole.
//   sums      64-bit whole numbers. A change adds to some of them: exactly, in any order, and what
//             was added can be taken away again to the last bit.
//
// What they mean is known to the method alone. A page that nobody has written has no bytes, and
// zeros as sums.
// Threads: plain values.   Errors: none.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

namespace ninefold {

inline constexpr size_t kPageBytes = 64 << 10;
inline constexpr size_t kPageSums = kPageBytes / sizeof(int64_t);

struct PageId {
  uint16_t kind = 0;   // by the method's own count; all pages of a kind have one form
  uint32_t index = 0;  // within the kind
  auto operator<=>(const PageId&) const = default;
};

using Records = std::vector<std::byte>;  // up to kPageBytes
using Sums = std::vector<int64_t>;       // kPageSums of them
using Page = std::variant<Records, Sums>;

struct SumChange {
  uint16_t place = 0;  // 0..kPageSums-1
  int64_t amount = 0;
  bool operator==(const SumChange&) const = default;
};

// What a change does to one page.
struct PageDelta {
  PageId page;
  std::variant<Records, std::vector<SumChange>> change;
  bool operator==(const PageDelta&) const = default;
};
using PageDeltas = std::vector<PageDelta>;

}  // namespace ninefold
