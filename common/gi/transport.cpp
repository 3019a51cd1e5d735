#include "common/gi/transport.h"

#include "common/math/rounding.h"

namespace ninefold {
namespace {

float fluxOf(const Emitters& emitters) {
  float flux = 0;
  for (size_t i = 0; i < emitters.size(); ++i) flux += maxComponent(emitters[i].flux);
  return flux;
}

// A light exactly in a ceiling would be hidden by it: spots go where they shine, points to the front.
std::vector<PunctualLight> offSurfaces(const Tracer& tracer) {
  std::vector<PunctualLight> lights = tracer.scene().lights;
  for (PunctualLight& light : lights)
    light.position =
        tracer.clearOf(light.position, light.kind == LightKind::spot ? light.direction : Vec3(0));
  return lights;
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
      lights(offSurfaces(t)),
      needs(needsOf(t.scene(), s.environment)),
      radius(isLit(begun) ? begun->radius : t.scene().bounds.radius()),
      lampFlux(isLit(begun) ? begun->lampFlux : fluxOf(emitters)),
      bound(s.bound / std::max(radius * radius, 1e-30f)),
      farRounding(kRayRounding * 2 * t.scene().bounds.radius()),
      targets(aimTargets(t.scene(), shader, isLit(begun) ? &begun->targets : nullptr)) {}

float Transport::lightBound(uint32_t emitter) const {
  if (!settings.compensate) return bound;  // the paper's: what is cut off stays away
  const Emitter& e = emitters[emitter];
  const float sides = e.doubleSided ? 2 : 1;
  return std::max(bound, streams.probability(emitter) / (sides * e.area));
}

}  // namespace ninefold
