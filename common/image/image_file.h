// image_file.h: pictures to and from files, by OpenImageIO. The name's extension tells the kind.
//
//   .exr  32-bit float R, G, B, then the extra channels; metadata as attributes "ninefold:key"
//   .hdr  R, G, B with a shared 8-bit exponent (1 % steps; no negative values); no extra channels
//   .png  8-bit sRGB through the tone map; no extra channels
//
// A file is whole or as it was before (written_file.h).
// Threads: reentrant.   Errors: Error with one line that names the file.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/image/image.h"
#include "common/image/image_limits.h"
#include "common/image/tone_map.h"

namespace ninefold {

// What shall be told about a picture: version, scene, seed, frames, settings...
using Metadata = std::vector<std::pair<std::string, std::string>>;

struct Picture {
  const RgbImage& beauty;
  std::vector<Channel> extras;  // each of the beauty's size
  Metadata metadata;
};

// Throws if `path` has another extension than above, or no file can be written there. Call it
// before the work that leads to the picture.
void checkOutputPath(const std::string& path);

// Writes the kind of file that the extension names; only .png uses `toneMap`. Throws Error.
void writeImage(const std::string& path, const Picture& picture,
                const ToneMap& toneMap = ToneMap());
// Writes a picture that was tone mapped already: the bytes that writeImage makes of its radiance.
void writePng(const std::string& path, const DisplayImage& picture);

// The bytes of the .exr file that writeImage writes.
std::vector<uint8_t> encodeExr(const Picture& picture);

// The picture in a file (decode.h).
RgbImage readImage(const std::string& path, ImageLimits limits = {16384, 16384 * 16384});

}  // namespace ninefold
