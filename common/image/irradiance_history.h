// irradiance_history.h: temporal reuse while only the camera moves. E' of the diffuse layer [W/m^2]
// belongs to a place, not to the eye. So the place x that a pixel p shows is looked up in the frame
// before:
//
//   H(x) = H_before + (E'(x) - H_before)/n
//   L(p) = beauty + reflectance (H - E')
//
//   n         number of frames that H is the mean of, this one included; at most kMost
//   H_before  interpolated between the four pixels around x's place in the frame before. Only those
//             count that show the same surface: normals within 25 degrees, and off the plane
//             through x by at most kOffPlane of the distance to x. Where too few do, x was hidden,
//             and n = 1.
//
// At rest each pixel goes on with itself, n up to kMostKept, and the picture stays what the film
// says. What was learned is there when the camera moves on.
//
// Fails:   where E' changes, old light would lag: whoever changes anything but camera and size
//          calls forget(). Light in mirrors and glass is not reused. Repeated interpolation blurs
//          by about a pixel.
// Source:  Walter, Drettakis and Parker 1999 (render cache); Scherzer et al. 2007 (reverse
//          reprojection).
// Proved:  tests/image/irradiance_history_test.cpp.
// Threads: blend for different tiles at once, between begin and frameDone.
// Memory:  40 bytes a pixel.   Errors: none.
#pragma once

#include <cstdint>
#include <vector>

#include "common/image/patch_filter.h"
#include "common/math/camera.h"
#include "common/math/units.h"

namespace ninefold {

class IrradianceHistory {
 public:
  static constexpr int kMost = 8;             // while something moves
  static constexpr int kMostKept = 255;       // at rest
  static constexpr float kOffPlane = 0.005f;  // of the distance to x
  static constexpr float kSameNormal = 0.9f;  // cosine
  static constexpr float kEnough = 0.25f;     // weight of those that show the same surface

  // Begins a frame, which looks back at the last one that was done.
  void begin(const Camera& camera, int width, int height);
  void frameDone() { isDone_ = true; }
  // Nothing of the past counts for the next frame.
  void forget() { isForgotten_ = true; }

  // After filter.compose with filter.keepIrradiance(true). moving: changes the tile's pixels in
  // `beauty`.
  void blend(const Patch& patch, const PatchFilter& filter, bool moving, RgbImage& beauty);

 private:
  struct Pixel {  // 20 bytes
    Vec3 irradiance{0};
    float depth = 0;  // along the camera's forward axis [m]; 0: nothing diffuse is there
    int8_t normal[3] = {};
    uint8_t frames = 0;  // that irradiance is the mean of
  };
  struct Frame {
    Camera camera;
    CameraRays rays;
    int width = 0, height = 0;
    std::vector<Pixel> pixels;
    size_t at(int x, int y) const { return pixelCount(width, y) + static_cast<size_t>(x); }
  };
  struct Past {
    Vec3 irradiance{0};
    float frames = 0;
  };
  Past pastOf(Vec3 x, Vec3 normal, Metres distance) const;
  // What pixel (x, y) of now_ shows, seen from `distance`, and its mean with the past, of at most
  // `most` frames.
  Pixel remembered(int x, int y, Vec3 fresh, Vec3 normal, Metres distance, int most) const;

  Frame now_, before_;
  bool isDone_ = false;  // now_ is whole
  bool isForgotten_ = true;
  bool isStill_ = false;  // before_ has the same camera and size
};

}  // namespace ninefold
