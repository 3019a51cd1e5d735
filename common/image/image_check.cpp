#include "common/image/image_check.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/base/error.h"

namespace ninefold {
namespace {

// No format here packs more pixels into a byte: a PNG of 1 bit has 8 * 1032 (deflate's limit), an
// EXR at most 256 rows of 16,384 in a block, which takes more than 64 bytes.
constexpr uint64_t kMaxPixelsPerByte = 65'536;

constexpr std::string_view kPng = "\x89PNG\r\n\x1a\n", kJpeg = "\xff\xd8\xff",
                           kExr = "\x76\x2f\x31\x01", kHdr = "#?";

bool startsWith(FileBytes file, std::string_view magic) {
  return file.size() >= magic.size() &&
         std::equal(magic.begin(), magic.end(), file.begin(),
                    [](char c, std::byte b) { return std::byte(c) == b; });
}

// TGA has no magic: a colour map flag of 0 or 1, a known image type, 8 to 32 bits a pixel.
bool looksLikeTga(FileBytes file) {
  if (file.size() < 18) return false;
  const auto at = [&](size_t i) { return std::to_integer<int>(file[i]); };
  const int type = at(2) & ~8;
  return at(1) <= 1 && type >= 1 && type <= 3 && at(16) >= 8 && at(16) <= 32;
}

}  // namespace

const char* plainFormat(FileBytes file) {
  if (startsWith(file, kPng)) return "png";
  if (startsWith(file, kJpeg)) return "jpeg";
  if (startsWith(file, "BM")) return "bmp";
  if (looksLikeTga(file)) return "targa";
  fail("not a PNG, JPEG, BMP or TGA image: convert it to PNG");
}

const char* pictureFormat(FileBytes file) {
  if (startsWith(file, kExr)) return "openexr";
  if (startsWith(file, kHdr)) return "hdr";
  if (startsWith(file, kPng)) return plainFormat(file);
  fail("not an EXR, HDR or PNG image: convert it to EXR");
}

void checkImageSize(uint64_t width, uint64_t height, size_t fileBytes, ImageLimits limits) {
  if (width > limits.side || height > limits.side)
    fail("{} x {} pixels, more than {} on a side: scale it down", width, height, limits.side);
  if (width * height > limits.texels)
    fail("{} x {} pixels are more than {}: scale it down", width, height,
         limits.isShared ? fmt::format("the {} that are left for all textures", limits.texels)
                         : fmt::format("{}", limits.texels));
  if (width * height / kMaxPixelsPerByte > fileBytes)
    fail("truncated: {} bytes cannot hold {} x {} pixels", fileBytes, width, height);
}

void checkImage(std::string_view format, FileBytes file, ImageLimits limits) {
  if (format == "png") checkPng(file);
  if (format == "jpeg") checkJpeg(file, limits);
  if (format == "bmp") checkBmp(file, limits);
  if (format == "openexr") checkExr(file, limits);
}

std::vector<std::byte> pixelsOf(std::string_view format, FileBytes file) {
  if (format == "png") return pixelsOfPng(file);
  if (format == "jpeg") return pixelsOfJpeg(file);
  return {};
}

}  // namespace ninefold
