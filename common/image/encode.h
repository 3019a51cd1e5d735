// encode.h: 8-bit texels to a PNG file in memory, without loss.
//
// Threads: reentrant.   Errors: throws Error.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace ninefold {

// channels 1..4: grey, grey + alpha, RGB, RGBA; rows top to bottom.
std::vector<uint8_t> encodePng(int width, int height, int channels,
                               std::span<const uint8_t> texels);

}  // namespace ninefold
