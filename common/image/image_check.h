// image_check.h: an image file in memory before a library opens it.
//
// A format is known by a file's first bytes, and only those below are let in; image_formats.h says
// what is looked for in each. The size that a file claims is held against the limits before memory
// is taken for pixels, and a file too short for its size is refused.
//
// Threads: reentrant.   Errors: throws Error that says what is wrong with the image.
#pragma once

#include <string_view>

#include "common/image/image_formats.h"

namespace ninefold {

// OpenImageIO's name of the format: of PNG, JPEG, BMP and TGA; of EXR, HDR and PNG.
const char* plainFormat(FileBytes file);
const char* pictureFormat(FileBytes file);

// As far as it is cheap to tell.
void checkImage(std::string_view format, FileBytes file, ImageLimits limits);

// What a library needs of a file that was checked; empty: all of it.
std::vector<std::byte> pixelsOf(std::string_view format, FileBytes file);

}  // namespace ninefold
