// environment.cpp: any bytes as the picture of --environment: an Error, or a picture of the size that it says, within
// limits.
#include <cstdlib>
#include <span>

#include "common/base/error.h"
#include "common/image/decode.h"
#include "common/image/image_file.h"
#include "tests/fuzz/fuzz.h"
#include "tests/scene/png_bytes.h"

namespace ninefold {
namespace {

constexpr ImageLimits kLimits{4096, 1 << 16};

RgbImage sample() {
  RgbImage image;
  image.reset(8, 4);
  for (size_t i = 0; i < image.count(); ++i)
    image.pixels.r[i] = 0.1f * static_cast<float>(i), image.pixels.g[i] = 100;
  return image;
}

std::vector<uint8_t> bytes(std::string_view text) { return {text.begin(), text.end()}; }

}  // namespace
}  // namespace ninefold

std::vector<std::vector<uint8_t>> ninefoldFuzzSeeds() {
  using namespace ninefold;
  const RgbImage image = sample();
  using namespace std::string_view_literals;
  return {
      encodeExr({image, {}, {}}),
      encodeExr({image, {{"Z", std::vector<float>(32, 1)}}, {{"seed", "1"}}}),
      bytes("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n\x80\x80\x80\x80\x40\x20\x10\x81"sv),
      bytes(
          "#?RADIANCE\nEXPOSURE=2\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 8\n\2\2\0\x08\x88\x80\x88\x80\x88\x80\x88\x81"sv),
      png(8, 4, 1, std::vector<uint8_t>(32, 100))};
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
