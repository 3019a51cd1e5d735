// emitter_power.h: how much the lights of a scene emit; Emitters builds its table from it.
//
// Owner: refers to the scene.   Threads: TriangleRadiance is one thread's; the functions are pure.
#pragma once

#include <map>

#include "common/scene/emitters.h"
#include "common/scene/texture_peaks.h"

namespace ninefold {

// `barycentrics` of the triangle's second and third corner.
TexturePlace placeAt(const Mesh& mesh, uint32_t triangle, Vec2 barycentrics);

// Flux of a punctual light in a scene of radius R [m]. solidAngles: Omega of each profile of the
// scene [sr], see light_profile.h.
Flux punctualFlux(const PunctualLight& light, float R, const std::vector<double>& solidAngles);

// The radiance of emissive triangles, one side.
class TriangleRadiance {
 public:
  struct Value {
    Radiance mean{0};  // over a fixed set of points
    // A hundredth of the brightest that it may have between them; 0 = surely black.
    float least = 0;
  };

  explicit TriangleRadiance(const Scene& scene) : scene_(&scene) {}
  Value of(const Mesh& mesh, uint32_t triangle);

 private:
  Radiance mean(const Mesh& mesh, uint32_t triangle) const;
  float peak(const Material& material, const Mesh& mesh, uint32_t triangle);

  const Scene* scene_;
  std::map<int, TexturePeaks> peaks_;  // by image
};

}  // namespace ninefold
