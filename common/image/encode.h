// encode.h: 8-bit texels to a file in memory: PNG without loss, JPEG with.
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

// RGB. quality 1..100: what libjpeg calls so.
std::vector<uint8_t> encodeJpeg(int width, int height, int quality,
                                std::span<const uint8_t> texels);

}  // namespace ninefold
