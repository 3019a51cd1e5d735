// JPEG (ITU-T T.81, annex B): markers, most with a segment of some length, and the data of scans.
#include <algorithm>

#include "common/base/error.h"
#include "common/image/image_formats.h"

namespace ninefold {
namespace {

constexpr size_t kAlone = 0xFF01, kFirstRestart = 0xFFD0, kEnd = 0xFFD9;
constexpr size_t kNotes = 0xFFE0, kColours = 0xFFEE, kLastNotes = 0xFFEF, kComment = 0xFFFE;

struct Part {
  size_t marker = 0;  // 0: what is no marker, data of a scan or bytes that libjpeg passes over
  FileBytes bytes;
};

bool isMarker(FileBytes file, size_t at) {
  const size_t word = bigEndian(file, at, 2);
  return word > 0xFF00 && word < 0xFFFF;
}

bool hasSegment(size_t marker) {
  return marker != kAlone && (marker < kFirstRestart || marker > kEnd);
}

// What begins at `at`, which is before the file's end. A segment that is cut off goes to the end.
Part partAt(FileBytes file, size_t at) {
  size_t end = at;
  while (end + 1 < file.size() && !isMarker(file, end)) ++end;
  if (end + 1 >= file.size()) return {0, file.subspan(at)};
  if (end > at) return {0, file.subspan(at, end - at)};
  const size_t marker = bigEndian(file, at, 2);
  if (!hasSegment(marker)) return {marker, file.subspan(at, 2)};
  const size_t left = file.size() - at;
  const size_t length = left < 4 ? left : 2 + std::max<size_t>(2, bigEndian(file, at + 2, 2));
  return {marker, file.subspan(at, std::min(left, length))};
}

// Of a frame header, the first segment that says a size.
bool isFrame(size_t marker) {
  return marker >= 0xFFC0 && marker <= 0xFFCF && marker != 0xFFC4 && marker != 0xFFC8 &&
         marker != 0xFFCC;
}

// What libjpeg itself reads of the notes is what colours and densities are meant: in the first and
// the last but one.
bool isNote(size_t marker) {
  return (marker > kNotes && marker <= kLastNotes && marker != kColours) || marker == kComment;
}

}  // namespace

// The library would make up the missing pixels.
void checkJpeg(FileBytes file, ImageLimits limits) {
  constexpr size_t kFrame = 2 + 2 + 1 + 2 + 2;  // marker, length, bits, height, width
  bool hasSize = false;
  for (size_t at = 0; at < file.size();) {
    const Part part = partAt(file, at);
    if (isFrame(part.marker) && part.bytes.size() >= kFrame && !hasSize) {
      hasSize = true;
      checkImageSize(bigEndian(part.bytes, 7, 2), bigEndian(part.bytes, 5, 2), file.size(), limits);
    }
    if (part.marker == kEnd) {
      if (!hasSize) fail("damaged: the JPEG does not say its size");
      return;
    }
    at += part.bytes.size();
  }
  fail("truncated: the JPEG ends in the middle");
}

std::vector<std::byte> pixelsOfJpeg(FileBytes file) {
  std::vector<std::byte> pixels;
  pixels.reserve(file.size());
  for (size_t at = 0; at < file.size();) {
    const Part part = partAt(file, at);
    if (!isNote(part.marker)) pixels.insert(pixels.end(), part.bytes.begin(), part.bytes.end());
    at += part.bytes.size();
  }
  return pixels;
}

}  // namespace ninefold
