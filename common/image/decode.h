// decode.h: compressed image files in memory to 8-bit texels, for textures.
//
// Only plain formats (PNG, JPEG, BMP, TGA) are let in, recognized by content. The header is held
// against the limits before memory is taken for pixels. A file too short for the size that it
// claims is refused at once. 16-bit channels are rounded to 8; alpha is never premultiplied.
//
// Threads: reentrant.
// Errors:  throws Error that says what is wrong with the image; the caller knows which one it is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace ninefold {

struct DecodedImage {
  int width = 0, height = 0, channels = 0;  // 1..4: grey, grey + alpha, RGB, RGBA
  std::vector<uint8_t> texels;              // rows top to bottom, width * height * channels
};

struct ImageLimits {
  uint64_t side = 0;    // largest width and height
  uint64_t texels = 0;  // largest width * height
};

DecodedImage decodeImage(std::span<const std::byte> file, ImageLimits limits);

}  // namespace ninefold
