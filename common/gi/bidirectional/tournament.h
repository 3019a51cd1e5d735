// tournament.h: which of many candidates are kept, each with a probability p of its own, so that
// those kept lie evenly among all. Two of them duel; at most one stays open:
//
//   a + b < 1    one is dropped: a stays with chance a/(a + b), and has p = a + b from here on
//   a + b >= 1   one is kept: a with chance (1 - b)/(2 - a - b); the other has p = a + b - 1
//
// The mean of each p stays as it was, and so does their sum. Candidates of the smallest cell of an
// octree duel first, then those that are open in cells side by side, and so on. So what replaces a
// candidate is near to it, and in each cell as many are kept as its probabilities add up to, within
// one.
//
// A duel's random number belongs to its cell. So when few candidates come, go, move or change their
// p, few others are kept instead. One number for all, as in systematic sampling, changes them all:
// frames in motion would flicker as with free random bits.
//
// Source:  pivotal method, Deville and Tille 1998; between neighbours: Grafstrom, Lundstrom and
//          Schelin, "Spatially Balanced Sampling through the Pivotal Method", 2012.
// Proved:  tests/gi/tournament_test.cpp.
// Threads: pure function.   Errors: none.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/math/units.h"
#include "common/math/vec.h"

namespace ninefold {

struct Contender {
  Vec3 position;
  double p = 0;  // in [0, 1]
};

// Indices of those kept, ascending: as many as the sum of p, up to rounding. radius: R; the
// smallest cells have a side of R/256. key: of the random numbers.
std::vector<uint32_t> tournament(std::span<const Contender> all, Metres radius, uint64_t key);

}  // namespace ninefold
