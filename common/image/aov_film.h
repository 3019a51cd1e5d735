// aov_film.h: the extra layers of an output picture, averaged over frames like the film.
//
//   albedo.R G B   N.x y z   Z   irradiance.R G B   caustic.R G B     means over frames
//   objectId                                                          of the newest frame
//
//   irradiance  E at the first hit, without neighbours, or the plane of that name where
//               the method has one                                                     [W/m^2]
//   caustic     the photons' part of E                                                 [W/m^2]
//   N           the mean, made unit again
//   Z           mean over those frames in which the pixel met a surface                [m]
//
// Threads: addPatch for different tiles at once, else one at a time.
#pragma once

#include <span>

#include "common/image/image.h"
#include "common/image/patch.h"

namespace ninefold {

class AovFilm {
 public:
  AovFilm(const TileGrid& grid, uint8_t extraMask);

  void clear();
  // A tile of the next frame.
  void addPatch(const Patch& patch);
  void frameDone() { ++frames_; }  // all its tiles were added
  // The planes that the mask names and the irradiance, in the order above. Pixels to which the next
  // frame came already have means with it.
  std::vector<Channel> channels() const;
  int64_t frames() const { return frames_; }

  // All that the next frames and channels() need, as visit(span).
  template <typename Self, typename Visit>
  static void visitKept(Self& self, Visit& visit) {
    visit(std::span(&self.frames_, 1));
    for (auto* means : {&self.albedo_, &self.normal_, &self.irradiance_, &self.caustic_})
      for (auto& mean : *means) visit(std::span(mean));
    visit(std::span(self.depth_)), visit(std::span(self.hits_)), visit(std::span(self.object_));
  }

 private:
  using Rgb = std::array<std::vector<double>, 3>;  // means over frames

  TileGrid grid_;
  uint8_t extraMask_;
  int64_t frames_ = 0;
  Rgb albedo_, normal_, irradiance_, caustic_;
  std::vector<double> depth_;
  std::vector<uint32_t> hits_;  // frames in which the pixel met a surface
  std::vector<float> object_;
};

}  // namespace ninefold
