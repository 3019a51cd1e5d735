#include "common/image/decode.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>
#include <string_view>

#include "common/base/error.h"

namespace ninefold {
namespace {

// Reads the file's bytes and nothing else: the library's own reader does not mind positions before
// the first byte, and damaged headers ask for them.
class BoundedReader : public OIIO::Filesystem::IOMemReader {
 public:
  using IOMemReader::IOMemReader;
  size_t read(void* to, size_t bytes) override {
    const size_t got = pread(to, bytes, m_pos);
    m_pos += static_cast<int64_t>(got);
    return got;
  }
  size_t pread(void* to, size_t bytes, int64_t offset) override {
    if (offset < 0 || static_cast<uint64_t>(offset) >= size()) return 0;
    return IOMemReader::pread(to, std::min(bytes, size() - static_cast<size_t>(offset)), offset);
  }
};

// No format here packs more than this many pixels into a byte (1-bit PNG: 8 * 1032 by deflate's
// limit).
constexpr uint64_t kMaxPixelsPerByte = 8256;

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

uint32_t crc32(std::span<const std::byte> bytes) {
  static const auto table = [] {
    std::array<uint32_t, 256> entries{};
    for (uint32_t i = 0; i < entries.size(); ++i) {
      entries[i] = i;
      for (int bit = 0; bit < 8; ++bit)
        entries[i] = (entries[i] >> 1) ^ ((entries[i] & 1) != 0 ? 0xEDB88320u : 0u);
    }
    return entries;
  }();
  uint32_t crc = ~0u;
  for (const std::byte b : bytes)
    crc = (crc >> 8) ^ table[(crc ^ std::to_integer<uint32_t>(b)) & 0xFF];
  return ~crc;
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
    if (crc32(checked) != bigEndian(file, at + 8 + length, 4))
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

// OpenImageIO's name of the format. Throws unless the file is whole, as far as is cheap to tell.
const char* formatOf(std::span<const std::byte> file) {
  if (startsWith(file, "\x89PNG\r\n\x1a\n")) return checkPng(file), "png";
  if (startsWith(file, "\xff\xd8\xff")) return checkJpeg(file), "jpeg";
  if (startsWith(file, "BM")) return "bmp";
  if (looksLikeTga(file)) return "targa";
  fail("not a PNG, JPEG, BMP or TGA image: convert it to PNG");
}

void checkSize(uint64_t width, uint64_t height, size_t fileBytes, ImageLimits limits) {
  if (width > limits.side || height > limits.side)
    fail("{} x {} pixels, more than {} on a side: scale it down", width, height, limits.side);
  if (width * height > limits.texels)
    fail("{} x {} pixels are more than the {} that are left for all textures: scale them down",
         width, height, limits.texels);
  if (width * height / kMaxPixelsPerByte > fileBytes)
    fail("truncated: {} bytes cannot hold {} x {} pixels", fileBytes, width, height);
}

void checkSize(const OIIO::ImageSpec& spec, size_t fileBytes, ImageLimits limits) {
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1)
    fail("an image of {} x {} x {} pixels", spec.width, spec.height, spec.depth);
  checkSize(static_cast<uint64_t>(spec.width), static_cast<uint64_t>(spec.height), fileBytes,
            limits);
  if (spec.nchannels < 1) fail("no channels");
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
      return checkSize(bigEndian(file, at + 7, 2), bigEndian(file, at + 5, 2), file.size(), limits);
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
    return checkSize(littleEndian(file, kSize, 2), littleEndian(file, kSize + 2, 2), file.size(),
                     limits);
  const auto height = static_cast<int32_t>(littleEndian(file, kSize + 4, 4));
  const auto rows = static_cast<uint64_t>(std::abs(int64_t{height}));  // negative: from the top
  checkSize(littleEndian(file, kSize, 4), rows, file.size(), limits);
}

// What OpenImageIO takes memory for all pixels of when it opens them: a BMP packed by runs, a JPEG
// in several scans.
void checkSizeBeforeOpening(std::string_view format, std::span<const std::byte> file,
                            ImageLimits limits) {
  if (format == "jpeg") checkJpegSize(file, limits);
  if (format == "bmp") checkBmpSize(file, limits);
}

// OpenImageIO's messages may have several lines.
std::string firstLine(const std::string& text) {
  if (text.empty()) return "unreadable";
  return text.substr(0, text.find('\n'));
}

}  // namespace

DecodedImage decodeImage(std::span<const std::byte> file, ImageLimits limits) {
  const char* format = formatOf(file);
  checkSizeBeforeOpening(format, file, limits);
  BoundedReader memory(file.data(), file.size());
  OIIO::ImageSpec config, spec;
  config["oiio:UnassociatedAlpha"] = 1;
  OIIO::Filesystem::IOProxy* proxy = &memory;
  config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  auto input = OIIO::ImageInput::create(format);
  if (!input) fail("{} images cannot be read: {}", format, firstLine(OIIO::geterror()));
  if (!input->open(std::string("memory.") + format, spec, config))
    fail("bad {} image: {}", format, firstLine(input->geterror()));
  checkSize(spec, file.size(), limits);
  DecodedImage image;
  image.width = spec.width, image.height = spec.height;
  image.channels = std::min(spec.nchannels, 4);
  image.texels.resize(static_cast<size_t>(image.width) * static_cast<size_t>(image.height) *
                      static_cast<size_t>(image.channels));
  if (!input->read_image(0, 0, 0, image.channels, OIIO::TypeDesc::UINT8, image.texels.data()))
    fail("bad {} image: {}", format, firstLine(input->geterror()));
  return image;
}

}  // namespace ninefold
