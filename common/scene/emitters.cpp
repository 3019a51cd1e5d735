#include "common/scene/emitters.h"

#include "common/scene/texture.h"
#include "common/scene/world.h"

namespace ninefold {
namespace {

struct TextureCoordinates {
  Vec2 uv0{0}, uv1{0};
};

Vec2 interpolate(const std::vector<Vec2>& uv, const Triangle& t, Vec2 b) {
  if (uv.empty()) return Vec2(0);
  return (1 - b.x - b.y) * uv[t.x] + b.x * uv[t.y] + b.y * uv[t.z];
}

TextureCoordinates coordinatesAt(const Mesh& mesh, uint32_t triangle, Vec2 barycentrics) {
  const Triangle& t = mesh.triangles[triangle];
  return {interpolate(mesh.uv0, t, barycentrics), interpolate(mesh.uv1, t, barycentrics)};
}

// Share of the light of a textured emitter's texel that is let through by the surface's own
// opacity.
float coverage(const Scene& scene, const Material& m, Vec2 uv0, Vec2 uv1) {
  if (m.alphaMode == AlphaMode::opaque) return 1.0f;
  const float alpha = m.baseColorMap ? lookUp(scene, m.baseColorMap, uv0, uv1).w : 1.0f;
  if (m.alphaMode == AlphaMode::mask) return m.opacity * alpha < m.alphaCutoff ? 0.0f : 1.0f;
  return std::clamp(m.opacity * alpha, 0.0f, 1.0f);
}

// Centroids of the n^2 congruent parts of a triangle, n = 8.
constexpr int kParts = 8;

// Mean of the radiance over the triangle's parts; `floor` is a hundredth of the brightest that a
// texel could be, so that no triangle that shines anywhere between the samples is ever left out.
struct TexturedRadiance {
  Vec3 mean{0};
  float floor = 0;
};

TexturedRadiance averageRadiance(const Emitters& emitters, const Scene& scene, const Mesh& mesh,
                                 uint32_t triangle) {
  const Material& material = scene.materials[static_cast<size_t>(mesh.material)];
  if (!material.emissionMap && material.alphaMode == AlphaMode::opaque)
    return {material.emission, 0};
  Vec3 sum(0);
  const auto add = [&](float i, float j) {
    const Vec2 b = Vec2(i, j) / (3.0f * kParts);
    const TextureCoordinates at = coordinatesAt(mesh, triangle, b);
    sum += emitters.radianceOf(mesh.material, at.uv0, at.uv1);
  };
  for (int i = 0; i < kParts; ++i)
    for (int j = 0; i + j < kParts; ++j) {
      add(static_cast<float>(3 * i + 1), static_cast<float>(3 * j + 1));
      if (i + j + 1 < kParts) add(static_cast<float>(3 * i + 2), static_cast<float>(3 * j + 2));
    }
  return {sum / static_cast<float>(kParts * kParts), 0.01f * maxComponent(material.emission)};
}

// Integral of glTF's falloff over the sphere: with c = cos, a ramp ((c - cos outer)/w)^2 of width
// w = max(0.001, cos inner - cos outer), then 1 up to the axis.
float spotSolidAngle(const PunctualLight& light) {
  const float outer = std::cos(light.outerCone);
  const float width = std::max(0.001f, std::cos(light.innerCone) - outer);
  const float ramp = std::min(width, 1 - outer);
  return 2 * kPi * (ramp * ramp * ramp / (3 * width * width) + (1 - outer - ramp));
}

Flux punctualFlux(const PunctualLight& light, float R) {
  switch (light.kind) {
    case LightKind::point:
      return 4 * kPi * light.intensity;
    case LightKind::spot:
      return spotSolidAngle(light) * light.intensity;
    case LightKind::directional:
      break;
  }
  return kPi * R * R * light.intensity;
}

EmitterKind kindOf(LightKind kind) {
  switch (kind) {
    case LightKind::point:
      return EmitterKind::point;
    case LightKind::spot:
      return EmitterKind::spot;
    case LightKind::directional:
      break;
  }
  return EmitterKind::directional;
}

Emitter triangleEmitter(const Mesh& mesh, const DMat4& toWorld, uint32_t triangle) {
  const Triangle& t = mesh.triangles[triangle];
  Emitter e;
  e.kind = EmitterKind::triangle;
  e.triangle = triangle;
  e.a = worldPoint(toWorld, mesh.positions[t.x]);
  e.b = worldPoint(toWorld, mesh.positions[t.y]);
  e.c = worldPoint(toWorld, mesh.positions[t.z]);
  const DVec3 cross = glm::cross(DVec3(e.b) - DVec3(e.a), DVec3(e.c) - DVec3(e.a));
  const double length = glm::length(cross);
  e.area = static_cast<float>(0.5 * length);
  if (length > 0) e.normal = Vec3(cross / (mirrors(toWorld) ? -length : length));
  return e;
}

}  // namespace

Emitters::Emitters(const Scene& scene, Radiance environment)
    : scene_(&scene), environment_(environment) {
  std::vector<float> power;
  const auto append = [&](Emitter e, float floor) {
    const float p = std::max(maxComponent(e.flux), floor);
    if (!(p > 0) || !std::isfinite(p)) return;
    emitters_.push_back(e), power.push_back(p);
  };
  firstOfInstance_.reserve(scene.instances.size() + 1);
  for (uint32_t i = 0; i < scene.instances.size(); ++i) {
    firstOfInstance_.push_back(static_cast<uint32_t>(emitters_.size()));
    const Mesh& mesh = scene.meshes[static_cast<size_t>(scene.instances[i].mesh)];
    const Material& material = scene.materials[static_cast<size_t>(mesh.material)];
    if (isBlack(material.emission)) continue;
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      Emitter e = triangleEmitter(mesh, scene.instances[i].toWorld, t);
      const TexturedRadiance L = averageRadiance(*this, scene, mesh, t);
      const float measure = kPi * e.area * (material.doubleSided ? 2.0f : 1.0f);
      e.instance = i, e.doubleSided = material.doubleSided, e.flux = measure * L.mean;
      append(e, measure * L.floor);
    }
  }
  firstOfInstance_.push_back(static_cast<uint32_t>(emitters_.size()));
  const float R = scene.bounds.radius();
  for (uint32_t i = 0; i < scene.lights.size(); ++i) {
    Emitter e;
    e.kind = kindOf(scene.lights[i].kind), e.light = i;
    e.flux = punctualFlux(scene.lights[i], R);
    append(e, 0);
  }
  Emitter sky;
  sky.kind = EmitterKind::environment, sky.flux = 4 * kPi * kPi * R * R * environment;
  append(sky, 0);
  byPower_ = Distribution(power);
}

EmitterPoint Emitters::pointAt(uint32_t emitter, Vec2 b) const {
  const Emitter& e = emitters_[emitter];
  const Mesh& mesh = scene_->meshes[static_cast<size_t>(scene_->instances[e.instance].mesh)];
  const TextureCoordinates at = coordinatesAt(mesh, e.triangle, b);
  EmitterPoint p;
  p.position = (1 - b.x - b.y) * e.a + b.x * e.b + b.y * e.c;
  p.radiance = radianceOf(mesh.material, at.uv0, at.uv1);
  // Seven roundings, each of at most half an ulp of the terms' magnitudes (Pharr et al. 3.9.4).
  constexpr float kUlp = 0.5f * std::numeric_limits<float>::epsilon();
  const Vec3 magnitude = glm::abs(e.a) + glm::abs(e.b) + glm::abs(e.c);
  p.error = 7 * kUlp / (1 - 7 * kUlp) * glm::length(magnitude);
  return p;
}

int Emitters::find(uint32_t instance, uint32_t triangle) const {
  const auto first = emitters_.begin() + firstOfInstance_[instance];
  const auto last = emitters_.begin() + firstOfInstance_[instance + 1];
  const auto found = std::lower_bound(first, last, triangle,
                                      [](const Emitter& e, uint32_t t) { return e.triangle < t; });
  if (found == last || found->triangle != triangle) return -1;
  return static_cast<int>(found - emitters_.begin());
}

Radiance Emitters::radianceOf(int material, Vec2 uv0, Vec2 uv1) const {
  const Material& m = scene_->materials[static_cast<size_t>(material)];
  if (isBlack(m.emission)) return Radiance(0);
  const Radiance L = coverage(*scene_, m, uv0, uv1) * m.emission;
  return m.emissionMap ? L * Vec3(lookUp(*scene_, m.emissionMap, uv0, uv1)) : L;
}

Intensity Emitters::intensity(const PunctualLight& light, Vec3 direction) {
  if (light.kind != LightKind::spot) return light.intensity;
  const float outer = std::cos(light.outerCone);
  const float width = std::max(0.001f, std::cos(light.innerCone) - outer);
  const float t = std::clamp((glm::dot(direction, light.direction) - outer) / width, 0.0f, 1.0f);
  return t * t * light.intensity;
}

}  // namespace ninefold
