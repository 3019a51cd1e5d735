#include "common/gi/light/transport.h"

#include "common/math/rounding.h"
#include "common/scene/world.h"

namespace ninefold {
namespace {

float fluxOf(const Emitters& emitters) {
  float flux = 0;
  for (size_t i = 0; i < emitters.size(); ++i) flux += maxComponent(emitters[i].flux);
  return flux;
}

// Where more of a punctual light goes to: along its axis, against it, or no way in particular.
Vec3 mainWay(const Emitters& emitters, const PunctualLight& light) {
  if (light.kind == LightKind::spot) return light.direction;
  if (light.kind != LightKind::goniometric) return Vec3(0);
  const double along = emitters.samplingOf(light).shareOnAxisSide();
  if (std::abs(along - 0.5) < 0.01) return Vec3(0);
  return along > 0.5 ? light.direction : -light.direction;
}

// A light exactly in a ceiling would be hidden by it. Lights with a direction move that way, others
// to the front of the surface.
std::vector<PunctualLight> offSurfaces(const Tracer& tracer, const Emitters& emitters) {
  std::vector<PunctualLight> lights = tracer.scene().lights;
  for (PunctualLight& light : lights)
    light.position = tracer.clearOf(light.position, mainWay(emitters, light));
  return lights;
}

Bounds boundsOf(const Scene& scene, const Instance& instance) {
  Bounds bounds;
  for (const Vec3& p : scene.meshes[static_cast<size_t>(instance.mesh)].positions)
    bounds.add(worldPoint(instance.toWorld, p));
  // A flat box needs some thickness, for rays in its plane.
  const float margin = 1e-4f * bounds.radius();
  bounds.low -= margin, bounds.high += margin;
  return bounds;
}

// Of the instances whose material is wanted.
template <typename IsWanted>
std::vector<Bounds> boundsOfAll(const Scene& scene, const IsWanted& isWanted) {
  constexpr size_t kMost = 16;  // more are one
  std::vector<Bounds> each;
  for (const Instance& instance : scene.instances)
    if (isWanted(scene.meshes[static_cast<size_t>(instance.mesh)].material))
      each.push_back(boundsOf(scene, instance));
  if (each.size() <= kMost) return each;
  Bounds all;
  for (const Bounds& b : each) all.add(b.low), all.add(b.high);
  return {all};
}

bool isLit(const Transport* begun) { return begun != nullptr && !begun->emitters.empty(); }

}  // namespace

Transport::Transport(const Tracer& t, const Settings& s, const Transport* begun)
    : tracer(t),
      scene(t.scene()),
      settings(s),
      shader(t.scene()),
      emitters(t.scene(), s.environment),
      streams(emitters, begun != nullptr ? &begun->emitters : nullptr),
      lights(offSurfaces(t, emitters)),
      needs(needsOf(t.scene(), s.environment)),
      radius(t.scene().bounds.radius()),
      lampFlux(isLit(begun) ? begun->lampFlux : fluxOf(emitters)),
      bound(s.bound / std::max(radius * radius, 1e-30f)),
      farRounding(kRayRounding * 2 * coverRadius(t.scene())),
      targets(aimTargets(t.scene(), shader, isLit(begun) ? &begun->targets : nullptr)),
      straightBounds(boundsOfAll(scene, [&](int m) { return shader.mayPassStraight(m); })),
      solidBounds(boundsOfAll(scene, [&](int m) { return shader.isSolid(m); })) {}

float Transport::lightBound(uint32_t emitter) const {
  if (!settings.compensate) return bound;  // as in the paper: nothing gives back what is cut off
  const Emitter& e = emitters[emitter];
  const float sides = e.doubleSided ? 2 : 1;
  return std::max(bound, streams.probability(emitter) / (sides * e.area));
}

}  // namespace ninefold
