// randomization.h: the ways to randomize samples, see sampler.h.
#pragma once

#include <cstdint>

namespace ninefold {

enum class Randomization : uint8_t { exclusiveOr, owen, random };

}  // namespace ninefold
