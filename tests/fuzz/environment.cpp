// environment.cpp: any bytes as the picture of --environment: an Error, or a picture of the size
// that it says, within limits.
#include <cstdlib>
#include <span>

#include "common/base/error.h"
#include "common/image/decode.h"
#include "tests/fuzz/fuzz.h"
#include "tests/image/library_image.h"

namespace ninefold {
namespace {

constexpr ImageLimits kLimits{4096, 1 << 16};

std::vector<uint8_t> bytes(std::string_view text) { return {text.begin(), text.end()}; }

}  // namespace
}  // namespace ninefold

std::vector<std::vector<uint8_t>> ninefoldFuzzSeeds() {
  using namespace ninefold;
  using namespace std::string_view_literals;
  std::vector<std::vector<uint8_t>> seeds = {
      bytes("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n\x80\x80\x80\x80\x40\x20\x10\x81"sv),
      bytes("#?RADIANCE\nEXPOSURE=2\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 8\n\2\2\0\x08"
            "\x88\x80\x88\x80\x88\x80\x88\x81"sv),
      libraryImage("hdr", 3, OIIO::TypeDesc::FLOAT), libraryImage("png", 3, OIIO::TypeDesc::UINT16),
      libraryImage("exr", 3, OIIO::TypeDesc::HALF, photoNotes(), 4)};
  for (const char* packing :
       {"none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"})
    for (const auto type : {OIIO::TypeDesc::HALF, OIIO::TypeDesc::FLOAT})
      seeds.push_back(libraryImage("exr", 4, type, {{"compression", packing}}));
  return seeds;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace ninefold;
  try {
    const RgbImage image = decodePicture(std::as_bytes(std::span(data, size)), kLimits);
    const size_t count = static_cast<size_t>(image.width) * static_cast<size_t>(image.height);
    if (count > kLimits.texels || image.pixels.b.size() != count) std::abort();
  } catch (const Error&) {
  }
  return 0;
}
