#include "common/scene/emitter_power.h"

#include "common/scene/texture.h"

namespace ninefold {
namespace {

constexpr int kParts = 8;  // a triangle is sampled at the centroids of its kParts^2 congruent parts

Vec2 interpolate(const std::vector<Vec2>& uv, const Triangle& t, Vec2 b) {
  if (uv.empty()) return Vec2(0);
  return (1 - b.x - b.y) * uv[t.x] + b.x * uv[t.y] + b.y * uv[t.z];
}

// Integral of glTF's falloff over the sphere [sr]. With c = cos it is a ramp ((c - cos outer)/w)^2
// of width w = max(0.001, cos inner - cos outer), then 1 up to the axis.
float spotSolidAngle(const PunctualLight& light) {
  const float outer = std::cos(light.outerCone);
  const float width = std::max(0.001f, std::cos(light.innerCone) - outer);
  const float ramp = std::min(width, 1 - outer);
  return 2 * kPi * (ramp * ramp * ramp / (3 * width * width) + (1 - outer - ramp));
}

}  // namespace

TexturePlace placeAt(const Mesh& mesh, uint32_t triangle, Vec2 barycentrics) {
  const Triangle& t = mesh.triangles[triangle];
  return {interpolate(mesh.uv0, t, barycentrics), interpolate(mesh.uv1, t, barycentrics),
          colorAt(mesh, t, barycentrics.x, barycentrics.y).w};
}

Flux punctualFlux(const PunctualLight& light, float R, const std::vector<double>& solidAngles) {
  switch (light.kind) {
    case LightKind::point:
      return 4 * kPi * light.intensity;
    case LightKind::spot:
      return spotSolidAngle(light) * light.intensity;
    case LightKind::goniometric:
      return static_cast<float>(solidAngles[static_cast<size_t>(light.profile)]) * light.intensity;
    case LightKind::directional:
      break;
  }
  return kPi * R * R * light.intensity;
}

TriangleRadiance::Value TriangleRadiance::of(const Mesh& mesh, uint32_t triangle) {
  const Material& m = scene_->materials[static_cast<size_t>(mesh.material)];
  if (!m.emissionMap && m.alphaMode == AlphaMode::opaque)
    return {m.emission, maxComponent(m.emission)};
  const float peakValue = peak(m, mesh, triangle);
  if (peakValue == 0) return {};
  return {mean(mesh, triangle), 0.01f * peakValue};
}

Radiance TriangleRadiance::mean(const Mesh& mesh, uint32_t triangle) const {
  Radiance sum(0);
  const auto add = [&](int i, int j) {
    const TexturePlace at = placeAt(mesh, triangle, Vec2(i, j) / (3.0f * kParts));
    sum += emittedRadiance(*scene_, mesh.material, at);
  };
  for (int i = 0; i < kParts; ++i)
    for (int j = 0; i + j < kParts; ++j) {
      add(3 * i + 1, 3 * j + 1);
      if (i + j + 1 < kParts) add(3 * i + 2, 3 * j + 2);
    }
  return sum / static_cast<float>(kParts * kParts);
}

// Upper bound of the largest component of the radiance.
float TriangleRadiance::peak(const Material& m, const Mesh& mesh, uint32_t triangle) {
  const TextureUse& use = m.emissionMap;
  if (!use) return maxComponent(m.emission);
  const TextureImage& image = scene_->images[static_cast<size_t>(use.image)];
  const TexturePeaks& peaks = peaks_.try_emplace(use.image, image).first->second;
  Vec2 low(std::numeric_limits<float>::infinity()), high = -low;
  for (const Vec2 corner : {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)}) {
    const TexturePlace at = placeAt(mesh, triangle, corner);
    const Vec2 uv = textureCoordinates(use, use.uvSet == 0 ? at.uv0 : at.uv1);
    low = glm::min(low, uv), high = glm::max(high, uv);
  }
  return maxComponent(m.emission) * peaks.largest(use, low, high);
}

}  // namespace ninefold
