// decode.h: image files in memory to 8-bit texels, for textures, and to pictures of linear floats.
// image_check.h says what is let in.
//
// Threads: reentrant.
// Errors:  throws Error that says what is wrong with the image; the caller knows which one it is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/image/image.h"
#include "common/image/image_limits.h"

namespace ninefold {

struct DecodedImage {
  int width = 0, height = 0, channels = 0;  // 1..4: grey, grey + alpha, RGB, RGBA
  std::vector<uint8_t> texels;              // rows top to bottom, width * height * channels
};

// PNG, JPEG, BMP or TGA. 16-bit channels are rounded to 8.
DecodedImage decodeImage(std::span<const std::byte> file, ImageLimits limits);

// EXR, HDR or PNG. The channels R, G, B, or the first three if none are named so; one channel
// is spread to all. Integers are decoded from sRGB.
RgbImage decodePicture(std::span<const std::byte> file, ImageLimits limits);

}  // namespace ninefold
