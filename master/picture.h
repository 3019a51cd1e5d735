// picture.h: from complete frames to the picture: discontinuity buffer, film, tone map, file.
//
// The image hash is of the film's mean, so it depends on the frames and their order alone.
// Threads: one at a time. Memory: the film's sums; no allocation per frame after the first.
// Errors: write throws Error that names the file.
#pragma once

#include <string>

#include "common/image/aov_film.h"
#include "common/image/film.h"
#include "common/image/frame_filter.h"
#include "common/image/image_file.h"
#include "common/scene/settings.h"

namespace ninefold {

class PictureMaker {
 public:
  struct Setup {
    TileGrid grid;
    Camera camera;
    uint8_t layerMask = kDiffuseBit;
    uint8_t extraMask = 0;  // 0: no extra layers in the file
    SurfaceTest surfaceTest = SurfaceTest::surface;
    float exposure = 0;  // [EV]
  };
  explicit PictureMaker(const Setup& setup);

  // Frames in the order of their index.
  void add(const FrameBuffer& frame, float neighbourWeight);

  int64_t frames() const { return film_.frames(); }
  double relativeError() const { return film_.relativeError(); }
  std::string imageHash() const;
  void write(const std::string& path, const Metadata& metadata) const;

 private:
  std::vector<Channel> extraChannels() const;

  const Setup setup_;
  FrameFilter filter_;
  RgbImage beauty_;
  Film film_;
  AovFilm aovs_;
};

}  // namespace ninefold
