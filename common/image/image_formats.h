// image_formats.h: what the bytes of image files say, format by format, for image_check.
//
// check...    throws Error if the file is cut off, damaged in a way that libraries pass over, or
//             claims too much of what they take memory for
// pixelsOf... is the file without what makes no pixels. The libraries read the notes of cameras and
//             programs (Exif, IPTC, XMP, profiles), too, and a damaged one must not matter.
//
// Threads: reentrant.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/image/image_limits.h"

namespace ninefold {

using FileBytes = std::span<const std::byte>;

inline size_t bigEndian(FileBytes file, size_t at, size_t bytes) {
  size_t value = 0;
  for (size_t i = 0; i < bytes; ++i) value = value << 8 | std::to_integer<size_t>(file[at + i]);
  return value;
}

inline size_t littleEndian(FileBytes file, size_t at, size_t bytes) {
  size_t value = 0;
  for (size_t i = bytes; i-- > 0;) value = value << 8 | std::to_integer<size_t>(file[at + i]);
  return value;
}

void checkImageSize(uint64_t width, uint64_t height, size_t fileBytes, ImageLimits limits);

void checkPng(FileBytes file);
std::vector<std::byte> pixelsOfPng(FileBytes file);

void checkJpeg(FileBytes file, ImageLimits limits);
std::vector<std::byte> pixelsOfJpeg(FileBytes file);

void checkBmp(FileBytes file, ImageLimits limits);

void checkExr(FileBytes file, ImageLimits limits);

}  // namespace ninefold
