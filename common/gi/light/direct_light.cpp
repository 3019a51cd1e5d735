#include "common/gi/light/direct_light.h"

#include "common/math/rounding.h"
#include "common/sampling/warp.h"

namespace ninefold {
namespace {

std::optional<LightSample> sampleTriangle(const Transport& t, const Emitter& e, uint32_t index,
                                          float P, const ShadingPoint& p, Vec2 u) {
  const EmitterPoint y = t.emitters.pointAt(index, squareToTriangle(u));
  const Vec3 towards = y.position - p.surface.position;
  const float d2 = glm::dot(towards, towards);
  if (d2 <= 0) return std::nullopt;
  LightSample s;
  s.w = towards / std::sqrt(d2);
  float cosY = -glm::dot(s.w, e.normal);
  if (e.doubleSided) cosY = std::abs(cosY);
  if (cosY <= 0) return std::nullopt;
  s.pdf = P / e.area * d2 / cosY;
  s.weight = y.radiance / s.pdf;
  s.origin = offsetOrigin(p.surface, s.w);
  const float error = y.error + kRayRounding * std::sqrt(d2);
  s.segment = offsetOrigin(y.position, e.normal, error, -s.w) - s.origin;
  return s;
}

LightSample sampleEnvironment(const Transport& t, float P, const ShadingPoint& p, Vec2 u) {
  LightSample s;
  s.w = t.emitters.sampleEnvironment(u);
  s.pdf = P * t.emitters.environmentPdf(s.w);
  s.weight = t.emitters.environment(s.w) / s.pdf;
  s.origin = offsetOrigin(p.surface, s.w), s.segment = s.w;
  s.tFar = std::numeric_limits<float>::infinity();
  return s;
}

std::optional<LightSample> samplePunctual(const Transport& t, const PunctualLight& light, float P,
                                          const ShadingPoint& p) {
  LightSample s;
  if (light.kind == LightKind::directional) {
    s.w = -light.direction;
    s.weight = light.intensity / P;
    s.origin = offsetOrigin(p.surface, s.w), s.segment = s.w;
    s.tFar = std::numeric_limits<float>::infinity();
    return s;
  }
  const Vec3 towards = light.position - p.surface.position;
  const float d2 = glm::dot(towards, towards);
  if (d2 <= 0) return std::nullopt;
  s.w = towards / std::sqrt(d2);
  s.weight = Emitters::intensity(t.scene, light, -s.w) / (d2 * P);
  s.origin = offsetOrigin(p.surface, s.w), s.segment = light.position - s.origin;
  return s;
}

}  // namespace

std::optional<LightSample> sampleLight(const Transport& t, size_t stream, const ShadingPoint& p,
                                       Vec2 u) {
  if (t.emitters.empty()) return std::nullopt;
  const auto choice = t.streams.choose(stream, u.x);
  if (!choice) return std::nullopt;
  const Emitter& e = t.emitters[choice->index];
  const Vec2 place(choice->remapped, u.y);
  if (e.kind == EmitterKind::triangle)
    return sampleTriangle(t, e, choice->index, choice->probability, p, place);
  if (e.kind == EmitterKind::environment)
    return sampleEnvironment(t, choice->probability, p, place);
  return samplePunctual(t, t.lights[e.light], choice->probability, p);
}

Vec3 lightTransmittance(const Transport& t, const ShadingPoint& p, const MediumStack& media,
                        bool through, const LightSample& light) {
  const int medium = through ? t.shader.pass(p, media).innermost() : t.shader.before(p, media);
  return t.shader.transmittance(medium, light.tFar * glm::length(light.segment));
}

float lightPdf(const Transport& t, const Hit& hit, const SurfacePoint& surface, Vec3 w,
               float distance) {
  const int index = t.emitters.find(hit.instance, hit.triangle);
  if (index < 0) return 0;
  const Emitter& e = t.emitters[static_cast<size_t>(index)];
  const float cosY = std::abs(glm::dot(w, surface.geometricNormal));
  if (cosY <= 0) return 0;
  return t.streams.probability(static_cast<uint32_t>(index)) / e.area * distance * distance / cosY;
}

float environmentPdf(const Transport& t, Vec3 w) {
  if (t.emitters.empty() || !t.emitters.hasEnvironment()) return 0;
  const size_t last = t.emitters.size() - 1;
  if (t.emitters[last].kind != EmitterKind::environment) return 0;  // a black picture
  return t.streams.probability(static_cast<uint32_t>(last)) * t.emitters.environmentPdf(w);
}

Radiance emittedRadiance(const Transport& t, const ShadingPoint& p) {
  const Material& m = t.scene.materials[static_cast<size_t>(p.surface.material)];
  if (isBlack(m.emission) || (!p.front && !m.doubleSided)) return Radiance(0);
  const SurfacePoint& s = p.surface;
  return t.emitters.radianceOf(s.material, {s.uv0, s.uv1, s.color.w});
}

}  // namespace ninefold
