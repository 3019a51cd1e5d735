// image_check.h: what is known of an image file in memory before a library opens it.
//
// A format is known by a file's first bytes, and only those below are let in. Damage that the
// libraries would pass over, or tell in lines of their own, is looked for here. So is what they take
// memory for by a number in the file alone: the size of a BMP, JPEG or EXR, and attributes of an EXR.
// A file too short for its size is refused.
//
// Threads: reentrant.   Errors: throws Error that says what is wrong with the image.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "common/image/image_limits.h"

namespace ninefold {

// OpenImageIO's name of the format: of PNG, JPEG, BMP and TGA; of EXR, HDR and PNG. Throws unless the
// file is whole, as far as is cheap to tell.
const char* plainFormat(std::span<const std::byte> file);
const char* pictureFormat(std::span<const std::byte> file);

// Before the file is opened.
void checkImage(std::string_view format, std::span<const std::byte> file, ImageLimits limits);

void checkImageSize(uint64_t width, uint64_t height, size_t fileBytes, ImageLimits limits);

}  // namespace ninefold
