// resampling.h: few of many candidates, in proportion to what they are worth.
//
//   p_j = min(1, c_j / tau)       sum p_j = N'     probability that candidate j is kept
//   c_j = v_j + mean(v)                            v_j: estimated worth
//
// What is kept is divided by p_j: the sum over those kept has the mean of the sum over all. A
// tournament between neighbours decides (tournament.h), so that N' are kept and none twice. A
// candidate that is worth a whole place is kept for certain, without noise. v_j may be a rough
// guess: every p_j is above 0, so that it costs noise, never bias. A worth that is not finite
// counts as 0.
//
// Half of the choice is blind, so that no gain 1/p_j is above 2 N/N'. What no judge sees may yet
// light a few pixels: with a larger gain it shows as a spot there.
//
// Source:  importance resampling, Talbot et al. 2005, as in Segovia et al. 2006, section 3.3, which
//          draws with replacement.
// Proved:  tests/gi/resampling_test.cpp.
// Threads: pure functions.   Errors: none.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/math/units.h"
#include "common/math/vec.h"

namespace ninefold {

struct Kept {
  uint32_t index;  // of the candidate
  float gain;      // 1/p_j
};

// worth: not negative; positions: of the candidates. count: N'; all are kept if there are no more.
// radius, key: as in tournament.h.
std::vector<Kept> resample(std::span<const float> worth, std::span<const Vec3> positions, int count,
                           Metres radius, uint64_t key);

}  // namespace ninefold
