// rest_touch.h: the last touch (image/denoise.h) of a picture at rest, as codes for the display.
// Radiance stays the film's mean: what is saved as light was never touched.
//
// A touch takes about as long as a frame, so it stays for a while. It is made anew when the film
// has a quarter more frames, and four, than at the last one: after 4, 9, 16, 24, 34, 47, ...
// frames. A still of which only the last frame is seen gets one.
//
// Not for frames that clients filter: they bring no guides. The first frames have no error, or a
// poor one, and are shown as they are, unless they are a still's last.
// Threads: addPatch for different tiles at once, else one at a time.   Errors: none.
// Memory: 20 bytes a pixel for the guides, 12 for what is shown; meanwhile as denoise.h says.
// Proved: tests/master/live_picture_test.cpp.
#pragma once

#include <optional>

#include "common/image/film.h"
#include "common/image/guide_film.h"
#include "common/image/tone_map.h"

namespace ninefold {

class RestTouch {
 public:
  // A frame begins. isFirst: it is the first of a new picture.
  void begin(const TileGrid& grid, bool isFirst);
  void addPatch(const Patch& patch) { guides_->addPatch(patch); }  // if the film took the tile
  void frameDone() { guides_->frameDone(); }
  // After the film's frame is done. mean: the film's. isLast: no further frame will be seen. Leaves
  // the codes alone where there is nothing to touch, or when it is stopped.
  void show(const Film& film, const RgbImage& mean, const ToneMap& toneMap, bool isLast,
            int threads, const std::stop_token& stop, DisplayImage& codes);

 private:
  std::optional<GuideFilm> guides_;
  int width_ = 0, height_ = 0;
  RgbImage touched_;
  int64_t frames_ = 0;  // of the film when it was touched; 0: not yet
};

}  // namespace ninefold
