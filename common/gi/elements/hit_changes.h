// hit_changes.h: what a row has lost and got since another version of it.
//
// After an edit most photons leave the hits that they left before, in the same order. So hits are
// gone through side by side. Where they differ, the nearest place is taken where they agree again.
// If there is none within kReach hits, one of each is passed over: then some hits are lost and got
// that are the same, which costs time and changes no sum.
//
// Proved:  tests/gi/hit_changes_test.cpp.   Threads: pure function.   Errors: none.
#pragma once

#include <span>

#include "common/gi/elements/photon_rows.h"

namespace ninefold {

// Calls lost(hit) and got(hit): `before` without the lost ones, with those got, has the hits of
// `now`.
template <typename Lost, typename Got>
void forEachChange(std::span<const ElementHit> before, std::span<const ElementHit> now,
                   const Lost& lost, const Got& got) {
  constexpr size_t kReach = 12;
  size_t i = 0, j = 0;
  const auto agree = [&](size_t a, size_t b) {
    return i + a < before.size() && j + b < now.size() && before[i + a] == now[j + b];
  };
  while (i < before.size() && j < now.size()) {
    if (agree(0, 0)) {
      ++i, ++j;
      continue;
    }
    size_t passed = 1, passedNow = 1;
    for (size_t sum = 1; sum <= kReach; ++sum) {
      size_t a = 0;
      while (a <= sum && !agree(a, sum - a)) ++a;
      if (a > sum) continue;
      passed = a, passedNow = sum - a;
      break;
    }
    for (; passed > 0 && i < before.size(); --passed) lost(before[i++]);
    for (; passedNow > 0 && j < now.size(); --passedNow) got(now[j++]);
  }
  while (i < before.size()) lost(before[i++]);
  while (j < now.size()) got(now[j++]);
}

}  // namespace ninefold
