// aov_film.h: the extra layers of an output picture, averaged over frames like the film.
//
//   albedo.R G B   N.x y z   Z   irradiance.R G B   caustic.R G B     means over frames
//   objectId                                                          of the newest frame
//
// irradiance is E at the first hit after the discontinuity buffer, caustic the photons' part of it
// before the buffer. N is made unit again. Z is the mean over those frames in which the pixel met a
// surface. Threads: one at a time.
#pragma once

#include "common/image/frame_filter.h"

namespace ninefold {

class AovFilm {
 public:
  AovFilm(const TileGrid& grid, uint8_t extraMask);

  void clear();
  // `filter` has just composed `frame`.
  void add(const FrameBuffer& frame, const FrameFilter& filter);
  // The planes that the mask names and the irradiance, in the order above.
  std::vector<Channel> channels() const;

 private:
  using Rgb = std::array<std::vector<double>, 3>;  // sums over frames
  void addDepth(int phase, const std::vector<float>& depth);

  TileGrid grid_;
  uint8_t extraMask_;
  int64_t frames_ = 0;
  Rgb albedo_, normal_, irradiance_, caustic_;
  std::vector<double> depth_;
  std::vector<uint32_t> hits_;  // frames in which the pixel met a surface
  std::vector<float> object_;
};

}  // namespace ninefold
