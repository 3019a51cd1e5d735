// image.h: a whole picture as planes, row-major from the top left: what filter, film, tone map and
// files hand to each other.
//
// Owner: whoever holds the value.   Threads: plain data.
#pragma once

#include <string>
#include <vector>

#include "common/image/layers.h"
#include "common/math/vec.h"

namespace ninefold {

inline size_t pixelCount(int width, int height) {
  return static_cast<size_t>(width) * static_cast<size_t>(height);
}

struct RgbImage {
  int width = 0, height = 0;
  RgbPlane pixels;  // linear Rec. 709, radiance unless the holder says otherwise

  // Sets the shape and makes all pixels black; keeps capacity.
  void reset(int w, int h) {
    width = w, height = h;
    pixels.resize(pixelCount(w, h));
  }
  // Old values may stay: for who writes all of them.
  void reshape(int w, int h) {
    width = w, height = h;
    pixels.reshape(pixelCount(w, h));
  }
  size_t count() const { return pixelCount(width, height); }
  size_t at(int x, int y) const { return pixelCount(width, y) + static_cast<size_t>(x); }
  Vec3 rgb(size_t i) const { return {pixels.r[i], pixels.g[i], pixels.b[i]}; }
  bool operator==(const RgbImage&) const = default;
};

// One further plane of a picture, named as in an EXR file: "albedo.R", "N.x", "Z", ...
struct Channel {
  std::string name;
  std::vector<float> values;
};

// Adds the channels layer.R, layer.G, layer.B.
void appendLayer(const std::string& layer, const RgbPlane& plane, std::vector<Channel>& channels);

// 64-bit FNV-1a over the size and the bits of R, G, B, plane by plane, as 16 hex digits. Equal
// pictures have equal hashes, and in practice only those. -0 and 0 differ: the promise is the same
// bytes.
std::string imageHash(const RgbImage& image);

}  // namespace ninefold
