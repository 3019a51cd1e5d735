// environment_map.h: light from outside as a picture of all directions (equirectangular).
//
//   L(w) = strength * picture at (phi, theta), bilinear between the middles of texels
//   theta  from up (+y), the picture's top, to down
//   phi    the picture's middle is +x, to the right of it lies +z (as in Blender and three.js);
//          `rotation` turns the picture about +y, counterclockwise for who looks down
//   strength: Scene::environment [W/(m^2 sr)]
//
// Directions are sampled by solid angle in proportion to
//
//   g = (1 - kAlike) y/mean y + kAlike,   y = (R+G+B)/3 of the picture     pdf(w) = g(w)/(4 pi)
//
// g is bilinear as L is, so that L/pdf <= 3 * 4 pi mean y/(1 - kAlike) everywhere: no sun is too
// small or too bright to be found. A tenth of the samples is shared alike by all directions: what
// is faint in the picture may be all that is seen from some place.
//
// Memory:  24 bytes a texel.   Proved: tests/scene/environment_map_test.cpp.
// Threads: const after construction.   Errors: the constructor throws Error on what is no picture.
#pragma once

#include <string>
#include <vector>

#include "common/math/units.h"
#include "common/scene/profile_sampling.h"

namespace ninefold {

inline constexpr int kWidestEnvironment = 4096;  // [texels]; it is half as high
inline constexpr float kBrightestTexel = 1e12f;

// What travels.
struct EnvironmentPicture {
  std::string
      name;  // the flag that asks for it again, FILE standing for a file; or empty: the scene's
  int width = 0, height = 0;  // width = 2 height
  std::vector<Vec3> texels;   // rows from the top; linear Rec. 709, times strength the radiance
  float rotation = 0;         // [rad]
};

class EnvironmentMap {
 public:
  explicit EnvironmentMap(EnvironmentPicture picture);
  EnvironmentMap(const EnvironmentMap&) = delete;  // sampling_ refers to weights_

  const EnvironmentPicture& picture() const { return picture_; }
  Vec3 mean() const { return mean_; }  // over all directions

  Vec3 towards(Vec3 w) const;  // the picture's value, unit w
  float pdf(Vec3 w) const;     // [1/sr]
  Vec3 sample(Vec2 u) const;   // unit w; u as ProfileSampling takes it

 private:
  const EnvironmentPicture picture_;
  const Vec3 across_;  // where phi is 0: the middle of the first column
  const Vec3 mean_;
  const LightProfile weights_;  // g over its largest value; a row at each pole, a column twice
  const ProfileSampling sampling_;
};

}  // namespace ninefold
