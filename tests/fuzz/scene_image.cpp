// scene_image.cpp: any bytes as a texture: an Error, or an image of the size that it says, within
// limits.
#include <cstdlib>
#include <span>
#include <string_view>

#include "common/base/error.h"
#include "common/image/decode.h"
#include "tests/fuzz/fuzz.h"
#include "tests/image/library_image.h"
#include "tests/scene/png_bytes.h"

std::vector<std::vector<uint8_t>> ninefoldFuzzSeeds() {
  using ninefold::libraryImage;
  const std::vector<uint8_t> grey(64, 100);
  std::vector<std::vector<uint8_t>> seeds = {
      ninefold::png(4, 4, 4, grey),
      ninefold::png(8, 4, 1, grey, 16),
      {0, 0, 10, 0, 0, 0, 0, 0, 0, 0, 0, 0, 4, 0, 1, 0, 24, 0x20, 0x83, 1, 2, 3},
      {'B', 'M', 58, 0, 0, 0, 0, 0, 0,  0, 54, 0, 0, 0, 40, 0, 0, 0, 1, 0,
       0,   0,   1,  0, 0, 0, 1, 0, 24, 0, 0,  0, 0, 0, 4,  0, 0, 0, 0, 0,
       0,   0,   0,  0, 0, 0, 0, 0, 0,  0, 0,  0, 0, 0, 1,  2, 3, 0},
      // Packed by runs, 0x6C69667A pixels wide: took 2 GB.
      {'B',  'M',  58,   0, 0, 0, 0, 0, 0, 0,  54, 0, 0, 0, 40, 0, 0, 0, 0x7A,
       0x66, 0x69, 0x6C, 1, 0, 0, 0, 1, 0, 24, 0,  2, 0, 0, 0,  4, 0, 0, 0,
       0,    0,    0,    0, 0, 0, 0, 0, 0, 0,  0,  0, 0, 0, 1,  2, 3, 0},
      // Packed by runs, but of true colours: no table.
      {'B', 'M', 58, 0, 0, 0, 0, 0, 0,  0, 54, 0, 0, 0, 40, 0, 0, 0, 1, 0,
       0,   0,   1,  0, 0, 0, 1, 0, 24, 0, 1,  0, 0, 0, 4,  0, 0, 0, 0, 0,
       0,   0,   0,  0, 0, 0, 0, 0, 0,  0, 0,  0, 0, 0, 1,  2, 0, 1}};
  for (const char* extension : {"jpg", "png", "bmp", "tga"})
    for (const int channels : {3, 4})
      for (const auto& notes : {ninefold::Notes{{"compression", "none"}}, ninefold::photoNotes()})
        if (channels == 3 || std::string_view(extension) != "jpg")
          seeds.push_back(libraryImage(extension, channels, OIIO::TypeDesc::UINT8, notes));
  seeds.push_back(libraryImage("jpg", 1, OIIO::TypeDesc::UINT8));
  seeds.push_back(libraryImage("tga", 4, OIIO::TypeDesc::UINT8, {{"compression", "rle"}}));
  return seeds;
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
