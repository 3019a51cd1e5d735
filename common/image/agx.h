// agx.h: the tone curve agx of tone_map.h, which has its formula and sources.
// Threads: reentrant.   Errors: none.
#pragma once

#include <array>
#include <cstdint>

#include "common/math/vec.h"

namespace ninefold {

// x: linear Rec. 709 with the exposure in it. What is negative or no number counts as 0.
std::array<uint8_t, 3> agxCodes(Vec3 x);

}  // namespace ninefold
