// emitters.h: all lights of a scene in one table, chosen in proportion to their power. A tenth of
// the choices is shared alike by all objects that shine (instances, punctual lights, environment):
// a faint lamp is found where a strong one is hidden.
//
//   triangle     Phi = pi L A (twice that if double-sided); L of a texture is averaged
//   point        Phi = 4 pi I
//   spot         Phi = I integrated over its cone with glTF's falloff
//   goniometric  Phi = I Omega, see light_profile.h
//   directional  Phi = E0 pi R^2
//   environment  Phi = mean L 4 pi pi R^2  (radiance from outside, constant or environment_map.h)
//
// Power is the largest component of Phi [W]: no channel of a light is ever starved. A textured
// triangle counts for at least a hundredth of what its brightest texel would make of it, so that no
// triangle that emits is missed; one that is black all over has no entry. Each emissive triangle is
// an entry of its own. Doubles (the same corners and flux) share one: one of them is seen.
//
// Owner: refers to the Scene.   Threads: const after construction.
#pragma once

#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

#include "common/sampling/distribution.h"
#include "common/scene/profile_sampling.h"
#include "common/scene/scene.h"

namespace ninefold {

enum class EmitterKind : uint8_t { triangle, point, spot, directional, goniometric, environment };

struct Emitter {
  EmitterKind kind = EmitterKind::triangle;
  uint32_t instance = 0, triangle = 0;  // triangle: where
  Vec3 a{0}, b{0}, c{0};     // triangle: world-space corners in the mesh's order, mirrored or not
  Vec3 normal{0};            // triangle: unit geometric normal of the front
  float area = 0;            // triangle [m^2]
  bool doubleSided = false;  // triangle
  uint32_t light = 0;        // punctual: index into Scene::lights
  Flux flux{0};              // total emitted flux [W], double sides included
};

// Names the object that shines (instance, punctual light, environment) in every state of a scene;
// ascends in a table of emitters.
inline uint32_t lampOf(const Emitter& e) {
  const bool triangle = e.kind == EmitterKind::triangle;
  const uint32_t group = triangle ? 0 : e.kind == EmitterKind::environment ? 2 : 1;
  return group << 30 | (triangle ? e.instance : e.light);
}

// A point on a triangle emitter.
struct EmitterPoint {
  Vec3 position{0};
  Radiance radiance{0};  // of each emitting side, textured
  float error = 0;       // float error bound of position, as SurfacePoint::error [m]
};

class TriangleRadiance;  // emitter_power.h

// What decides about a material's look at one point of a triangle.
struct TexturePlace {
  Vec2 uv0{0}, uv1{0};
  float alpha = 1;  // of the vertices' colours
};

// Radiance that an emissive triangle sends from a place, one side, times the surface's own opacity
// (alpha mask, blending).
Radiance emittedRadiance(const Scene& scene, int material, const TexturePlace& at);

class Emitters {
 public:
  // `environment` replaces the scene's own. R = scene.bounds.radius().
  Emitters(const Scene& scene, Radiance environment);

  // True if the scene has an emitter with flux, its environment aside.
  static bool anyIn(const Scene& scene);

  bool empty() const { return emitters_.empty(); }  // no emitter with flux
  size_t size() const { return emitters_.size(); }
  const Emitter& operator[](size_t i) const { return emitters_[i]; }
  const Distribution& byPower() const { return byPower_; }

  // Radiance from outside, out of unit direction w.
  Radiance environment(Vec3 w) const {
    if (map_ == nullptr || isBlack(environment_)) return environment_;
    return environment_ * map_->towards(w);
  }
  // Where the environment's light comes from, and the density of that [1/sr]. u in [0, 1)^2.
  Vec3 sampleEnvironment(Vec2 u) const;
  float environmentPdf(Vec3 w) const;
  bool hasEnvironment() const { return !isBlack(environment_); }
  Radiance environmentStrength() const { return environment_; }

  EmitterPoint pointAt(uint32_t emitter, Vec2 barycentrics) const;  // barycentrics of b and c
  // Entry of an emissive triangle, or -1.
  int find(uint32_t instance, uint32_t triangle) const;
  Radiance radianceOf(int material, const TexturePlace& at) const {
    return emittedRadiance(*scene_, material, at);
  }
  // I(omega) of a punctual light of the scene towards unit `direction` (from the light) [W/sr].
  static Intensity intensity(const Scene& scene, const PunctualLight& light, Vec3 direction);
  // Of a goniometric light: samples its directions.
  const ProfileSampling& samplingOf(const PunctualLight& light) const {
    return profiles_[static_cast<size_t>(light.profile)];
  }

 private:
  using Places = std::unordered_map<uint64_t, uint32_t>;  // entries by a hash of their corners
  void addTriangles(uint32_t instance, TriangleRadiance& radiance, Places& places,
                    std::vector<float>& power);
  void append(const Emitter& emitter, float itsPower, std::vector<float>& power);

  const Scene* scene_;
  std::vector<Emitter> emitters_;          // triangles first, by instance, then by triangle
  std::vector<uint32_t> firstOfInstance_;  // where an instance's triangles begin, and the end
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> doubles_;  // (instance, triangle): its entry
  std::vector<ProfileSampling> profiles_;                      // one for each of the scene's
  Distribution byPower_;
  Radiance environment_{0};              // strength of the map, or all of it
  const EnvironmentMap* map_ = nullptr;  // the scene's
};

}  // namespace ninefold
