// guide_film.h: means over frames of what pixels show, for denoise.h. It is in the layers that
// clients send in any case. Methods without filter, and clients that filter, send no layers.
//
//   albedo     pi times the layers' reflectance, mean of the channels
//   normal     of the first layer that ends on a surface
//   nearness   1/distance along the path to it; 0 where no layer does                     [1/m]
//
// Dark layers say nothing. Whole picture: the same samples as the film's, so that what coverage
// does to a colour at an edge is in its guides, too.
//
// Proved:  tests/image/guide_film_test.cpp.
// Threads: addPatch for different tiles at once, else one at a time.   Memory: 20 bytes a pixel.
#pragma once

#include <span>

#include "common/image/denoise.h"
#include "common/image/patch.h"

namespace ninefold {

class GuideFilm {
 public:
  GuideFilm(int width, int height) : width_(width), pixels_(pixelCount(width, height)) {}

  void clear();                       // the picture has changed: start again
  void addPatch(const Patch& patch);  // a tile of the next frame, each once
  void frameDone() { ++frames_; }     // all its tiles were added
  int64_t frames() const { return frames_; }

  struct Pixel {
    float albedo = 0, nearness = 0;
    Vec3 normal{0};
  };
  DenoiseGuides guides() const;

  // All that the next frames and guides() need, as visit(span).
  template <typename Self, typename Visit>
  static void visitKept(Self& self, Visit& visit) {
    visit(std::span(&self.frames_, 1));
    visit(std::span(self.pixels_));
  }

 private:
  static Pixel seen(const Patch& patch, int phase, size_t i);

  int width_;
  int64_t frames_ = 0;
  std::vector<Pixel> pixels_;  // means
};

}  // namespace ninefold
