// scene_image.cpp: any bytes as a texture: an Error, or an image of the size that it says, within
// limits.
#include <cstdlib>
#include <span>

#include "common/base/error.h"
#include "common/image/decode.h"
#include "tests/fuzz/fuzz.h"
#include "tests/scene/png_bytes.h"

std::vector<std::vector<uint8_t>> ninefoldFuzzSeeds() {
  const std::vector<uint8_t> grey(64, 100);
  return {ninefold::png(4, 4, 4, grey),
          ninefold::png(8, 4, 1, grey, 16),
          {0, 0, 10, 0, 0, 0, 0, 0, 0, 0, 0, 0, 4, 0, 1, 0, 24, 0x20, 0x83, 1, 2, 3},
          {'B', 'M', 58, 0, 0, 0, 0, 0, 0,  0, 54, 0, 0, 0, 40, 0, 0, 0, 1, 0,
           0,   0,   1,  0, 0, 0, 1, 0, 24, 0, 0,  0, 0, 0, 4,  0, 0, 0, 0, 0,
           0,   0,   0,  0, 0, 0, 0, 0, 0,  0, 0,  0, 0, 0, 1,  2, 3, 0},
          // Packed by runs, 0x6C69667A pixels wide: took 2 GB.
          {'B',  'M',  58,   0, 0, 0, 0, 0, 0, 0,  54, 0, 0, 0, 40, 0, 0, 0, 0x7A,
           0x66, 0x69, 0x6C, 1, 0, 0, 0, 1, 0, 24, 0,  2, 0, 0, 0,  4, 0, 0, 0,
           0,    0,    0,    0, 0, 0, 0, 0, 0, 0,  0,  0, 0, 0, 1,  2, 3, 0}};
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  try {
    const auto image = ninefold::decodeImage(std::as_bytes(std::span(data, size)), {4096, 1 << 20});
    if (image.texels.size() != static_cast<size_t>(image.width * image.height * image.channels))
      std::abort();
  } catch (const ninefold::Error&) {
  }
  return 0;
}
