// randomization.h: the two ways to randomize a Sobol' sequence, see sampler.h.
#pragma once

#include <cstdint>

namespace ninefold {

enum class Randomization : uint8_t { exclusiveOr, owen };

}  // namespace ninefold
