// PNG (ISO/IEC 15948): a signature, then chunks: length, type, that many bytes, checksum.
#include <boost/crc.hpp>

#include "common/base/error.h"
#include "common/image/image_formats.h"

namespace ninefold {
namespace {

constexpr size_t kSignature = 8, kFrame = 4 + 4 + 4;  // of a chunk: length, type, checksum
constexpr size_t kEnd = 0x49454E44, kTransparent = 0x74524E53;  // "IEND", "tRNS"
constexpr size_t kAncillary = 0x20000000;                       // of a type: it may be left out

// The chunk at `at`, or nothing if the file ends before its end.
FileBytes chunkAt(FileBytes file, size_t at) {
  if (file.size() - at < kFrame) return {};
  const size_t length = bigEndian(file, at, 4);
  return length > file.size() - at - kFrame ? FileBytes() : file.subspan(at, length + kFrame);
}

size_t typeOf(FileBytes chunk) { return bigEndian(chunk, 4, 4); }

bool makesPixels(size_t type) { return (type & kAncillary) == 0 || type == kTransparent; }

bool isWhole(FileBytes chunk) {
  boost::crc_32_type crc;
  crc.process_bytes(&chunk[4], chunk.size() - 8);
  return crc.checksum() == bigEndian(chunk, chunk.size() - 4, 4);
}

}  // namespace

// The library would print lines of its own about a wrong checksum, or make up the missing pixels.
void checkPng(FileBytes file) {
  for (size_t at = kSignature; at <= file.size();) {
    const FileBytes chunk = chunkAt(file, at);
    if (chunk.empty()) break;
    if (makesPixels(typeOf(chunk)) && !isWhole(chunk))
      fail("damaged: a checksum of the PNG is wrong");
    if (typeOf(chunk) == kEnd) return;
    at += chunk.size();
  }
  fail("truncated: the PNG ends in the middle");
}

std::vector<std::byte> pixelsOfPng(FileBytes file) {
  std::vector<std::byte> pixels(file.begin(), file.begin() + kSignature);
  for (size_t at = kSignature; at < file.size();) {
    const FileBytes chunk = chunkAt(file, at);
    if (chunk.empty()) break;
    const size_t type = typeOf(chunk);
    if (makesPixels(type)) pixels.insert(pixels.end(), chunk.begin(), chunk.end());
    if (type == kEnd) break;
    at += chunk.size();
  }
  return pixels;
}

}  // namespace ninefold
