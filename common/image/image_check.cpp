#include "common/image/image_check.h"

#include <algorithm>
#include <boost/crc.hpp>
#include <cstdlib>
#include <cstring>

#include "common/base/error.h"

namespace ninefold {
namespace {

// No format here packs more pixels into a byte: a PNG of 1 bit has 8 * 1032 (deflate's limit), an EXR
// at most 256 rows of 16,384 in a block, which takes more than 64 bytes.
constexpr uint64_t kMaxPixelsPerByte = 65'536;

constexpr std::string_view kPng = "\x89PNG\r\n\x1a\n", kJpeg = "\xff\xd8\xff",
                           kExr = "\x76\x2f\x31\x01", kHdr = "#?";

bool startsWith(std::span<const std::byte> file, std::string_view magic) {
  return file.size() >= magic.size() &&
         std::equal(magic.begin(), magic.end(), file.begin(),
                    [](char c, std::byte b) { return std::byte(c) == b; });
}

size_t bigEndian(std::span<const std::byte> file, size_t at, int bytes) {
  size_t value = 0;
  for (int i = 0; i < bytes; ++i)
    value = value << 8 | std::to_integer<size_t>(file[at + static_cast<size_t>(i)]);
  return value;
}

size_t littleEndian(std::span<const std::byte> file, size_t at, int bytes) {
  size_t value = 0;
  for (int i = bytes - 1; i >= 0; --i)
    value = value << 8 | std::to_integer<size_t>(file[at + static_cast<size_t>(i)]);
  return value;
}

// Damage is looked for here because the libraries would print lines of their own about it, or make
// up the missing pixels.
void checkPng(std::span<const std::byte> file) {
  constexpr size_t kSignature = 8, kFrame = 4 + 4 + 4;  // of a chunk: length, type, checksum
  constexpr size_t kEnd = 0x49454E44;                   // "IEND"
  for (size_t at = kSignature; file.size() - at >= kFrame;) {
    const size_t length = bigEndian(file, at, 4);
    if (length > file.size() - at - kFrame) break;
    const auto checked = file.subspan(at + 4, 4 + length);
    boost::crc_32_type crc;
    crc.process_bytes(checked.data(), checked.size());
    if (crc.checksum() != bigEndian(file, at + 8 + length, 4))
      fail("damaged: a checksum of the PNG is wrong");
    if (bigEndian(checked, 0, 4) == kEnd) return;
    at += length + kFrame;
  }
  fail("truncated: the PNG ends in the middle");
}

// Segments up to the start of the scan, then an end marker behind it.
void checkJpeg(std::span<const std::byte> file) {
  constexpr size_t kScan = 0xFFDA, kEnd = 0xFFD9;
  size_t at = 2;
  while (file.size() - at >= 4 && bigEndian(file, at, 2) != kScan) {
    const size_t length = 2 + bigEndian(file, at + 2, 2);
    if (length > file.size() - at) break;
    at += length;
  }
  for (; file.size() - at >= 2; ++at)
    if (bigEndian(file, at, 2) == kEnd) return;
  fail("truncated: the JPEG ends in the middle");
}

// TGA has no magic: a colour map flag of 0 or 1, a known image type, 8 to 32 bits a pixel.
bool looksLikeTga(std::span<const std::byte> file) {
  if (file.size() < 18) return false;
  const auto at = [&](size_t i) { return std::to_integer<int>(file[i]); };
  const int type = at(2) & ~8;
  return at(1) <= 1 && type >= 1 && type <= 3 && at(16) >= 8 && at(16) <= 32;
}

// Of a frame header, the first segment that says a size.
bool isJpegFrame(size_t marker) {
  return marker >= 0xFFC0 && marker <= 0xFFCF && marker != 0xFFC4 && marker != 0xFFC8 &&
         marker != 0xFFCC;
}

void checkJpegSize(std::span<const std::byte> file, ImageLimits limits) {
  constexpr size_t kFrame = 2 + 2 + 1 + 2 + 2;  // marker, length, bits, height, width
  for (size_t at = 2; file.size() - at >= kFrame;) {
    const size_t marker = bigEndian(file, at, 2);
    if (marker <= 0xFF00 || marker == 0xFFFF) {  // libjpeg passes over what is no marker
      ++at;
      continue;
    }
    if (marker == 0xFF01 || (marker >= 0xFFD0 && marker <= 0xFFD7)) {  // alone
      at += 2;
      continue;
    }
    const bool hasLength = marker >= 0xFFC0 && marker != 0xFFD8 && marker != 0xFFD9;
    if (!hasLength) break;
    if (isJpegFrame(marker))
      return checkImageSize(bigEndian(file, at + 7, 2), bigEndian(file, at + 5, 2), file.size(),
                            limits);
    const size_t length = 2 + bigEndian(file, at + 2, 2);
    if (length > file.size() - at) break;
    at += length;
  }
  fail("damaged: the JPEG does not say its size");
}

void checkBmpSize(std::span<const std::byte> file, ImageLimits limits) {
  constexpr size_t kInfo = 14, kSize = kInfo + 4, kEnd = kSize + 8, kOldInfo = 12;
  if (file.size() < kEnd) fail("truncated: the BMP ends in its header");
  if (littleEndian(file, kInfo, 4) == kOldInfo)
    return checkImageSize(littleEndian(file, kSize, 2), littleEndian(file, kSize + 2, 2),
                          file.size(), limits);
  const auto height = static_cast<int32_t>(littleEndian(file, kSize + 4, 4));
  const auto rows = static_cast<uint64_t>(std::abs(int64_t{height}));  // negative: from the top
  checkImageSize(littleEndian(file, kSize, 4), rows, file.size(), limits);
}

// The bytes before the next zero from `at` on, which then is behind that.
std::string_view exrName(std::span<const std::byte> file, size_t& at) {
  const auto rest = file.subspan(at);
  const auto end = std::ranges::find(rest, std::byte(0));
  if (end == rest.end()) fail("truncated: the EXR ends in its header");
  const auto length = static_cast<size_t>(end - rest.begin());
  at += length + 1;
  return {reinterpret_cast<const char*>(rest.data()), length};
}

// Attributes up to an empty name: name, type, size, value.
void checkExrHeader(std::span<const std::byte> file, size_t& at, ImageLimits limits) {
  constexpr size_t kBox = 4 * 4;
  for (auto name = exrName(file, at); !name.empty(); name = exrName(file, at)) {
    exrName(file, at);
    if (file.size() - at < 4) fail("truncated: the EXR ends in its header");
    const size_t size = littleEndian(file, at, 4);
    at += 4;
    if (size > file.size() - at) fail("truncated: the EXR ends in its attribute {}", name);
    const auto corner = [&](size_t i) {
      return static_cast<int32_t>(littleEndian(file, at + 4 * i, 4));
    };
    if (name == "dataWindow" && size == kBox)
      checkImageSize(
          static_cast<uint64_t>(std::max(int64_t{corner(2)} - corner(0) + 1, int64_t{0})),
          static_cast<uint64_t>(std::max(int64_t{corner(3)} - corner(1) + 1, int64_t{0})),
          file.size(), limits);
    at += size;
  }
}

// One header, or, with a flag, many that end at an empty one.
void checkExr(std::span<const std::byte> file, ImageLimits limits) {
  constexpr size_t kVersion = 4, kFirst = 8, kManyParts = 0x1000;
  if (file.size() <= kFirst) fail("truncated: the EXR ends in its header");
  size_t at = kFirst;
  checkExrHeader(file, at, limits);
  if ((littleEndian(file, kVersion, 4) & kManyParts) == 0) return;
  while (at < file.size() && file[at] != std::byte(0)) checkExrHeader(file, at, limits);
}

}  // namespace

const char* plainFormat(std::span<const std::byte> file) {
  if (startsWith(file, kPng)) return checkPng(file), "png";
  if (startsWith(file, kJpeg)) return checkJpeg(file), "jpeg";
  if (startsWith(file, "BM")) return "bmp";
  if (looksLikeTga(file)) return "targa";
  fail("not a PNG, JPEG, BMP or TGA image: convert it to PNG");
}

const char* pictureFormat(std::span<const std::byte> file) {
  if (startsWith(file, kExr)) return "openexr";
  if (startsWith(file, kHdr)) return "hdr";
  if (startsWith(file, kPng)) return plainFormat(file);
  fail("not an EXR, HDR or PNG image: convert it to EXR");
}

void checkImageSize(uint64_t width, uint64_t height, size_t fileBytes, ImageLimits limits) {
  if (width > limits.side || height > limits.side)
    fail("{} x {} pixels, more than {} on a side: scale it down", width, height, limits.side);
  if (width * height > limits.texels)
    fail("{} x {} pixels are more than the {} that are left for all textures: scale them down",
         width, height, limits.texels);
  if (width * height / kMaxPixelsPerByte > fileBytes)
    fail("truncated: {} bytes cannot hold {} x {} pixels", fileBytes, width, height);
}

void checkImage(std::string_view format, std::span<const std::byte> file, ImageLimits limits) {
  if (format == "jpeg") checkJpegSize(file, limits);
  if (format == "bmp") checkBmpSize(file, limits);
  if (format == "openexr") checkExr(file, limits);
}

}  // namespace ninefold
