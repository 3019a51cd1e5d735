#include "common/scene/gltf_lights.h"

#include <algorithm>
#include <cmath>

#include "common/base/log.h"
#include "common/scene/gltf_transform.h"
#include "common/scene/gltf_value.h"
#include "common/scene/world.h"

namespace ninefold {
namespace {

// Angles out of order or range become the nearest ones that make sense.
void setCone(const tinygltf::Light& from, PunctualLight& light) {
  constexpr float kRounding = 1e-4f;
  const auto outer = static_cast<float>(from.spot.outerConeAngle),
             inner = static_cast<float>(from.spot.innerConeAngle);
  if (!std::isfinite(outer) || !std::isfinite(inner))
    fail("light '{}': its cone is not a finite number", light.name);
  light.outerCone = std::clamp(outer, 0.0f, 0.5f * kPi);
  light.innerCone = std::clamp(inner, 0.0f, light.outerCone);
  if (std::abs(light.outerCone - outer) > kRounding ||
      std::abs(light.innerCone - inner) > kRounding)
    warn("light '{}': cone angles {:.4g} and {:.4g} are read as {:.4g} and {:.4g}", light.name,
         inner, outer, light.innerCone, light.outerCone);
}

}  // namespace

GltfLights::GltfLights(const GltfFile& file, const SceneFolder& folder, SceneDraft& draft)
    : model_(file.model.get()), draft_(&draft), profiles_(file, folder, draft.scene) {}

void GltfLights::add(const tinygltf::Node& node, const DMat4& toWorld) {
  if (const auto* e = extensionOf(node, "KHR_lights_punctual"))
    addPunctual(node, integerOr(*e, "light", -1), toWorld);
  if (const auto* e = extensionOf(node, "EXT_lights_ies")) addProfiled(node, *e, toWorld);
}

void GltfLights::addPunctual(const tinygltf::Node& node, int index, const DMat4& toWorld) {
  if (index < 0 || static_cast<size_t>(index) >= model_->lights.size())
    fail("light {} does not exist", index);
  const tinygltf::Light& from = model_->lights[static_cast<size_t>(index)];
  PunctualLight light;
  light.name = node.name.empty() ? from.name : node.name;
  if (from.type == "spot")
    light.kind = LightKind::spot;
  else if (from.type == "directional")
    light.kind = LightKind::directional;
  else if (from.type != "point")
    fail("light {} is of the unknown type '{}'", index, from.type);
  const auto strength = static_cast<float>(from.intensity);
  light.intensity = Vec3(strength);
  for (int c = 0; c < 3 && from.color.size() == 3; ++c)
    light.intensity[c] *= static_cast<float>(from.color[static_cast<size_t>(c)]);
  if (light.kind == LightKind::spot) setCone(from, light);
  keep(std::move(light), toWorld);
}

// The matrix turns it, and mirrors what it sends if the matrix mirrors; its size is of no account.
void GltfLights::addProfiled(const tinygltf::Node& node, const tinygltf::Value& use,
                             const DMat4& toWorld) {
  const GltfProfiles::Light from = profiles_.use(use, mirrors(toWorld));
  const Scene& scene = draft_->scene;
  PunctualLight light;
  light.name =
      node.name.empty() ? scene.profiles[static_cast<size_t>(from.profile)].name : node.name;
  light.kind = LightKind::goniometric;
  light.profile = from.profile, light.intensity = from.intensity;
  keep(std::move(light), toWorld);
  PunctualLight& kept = draft_->scene.lights.back();
  kept.across = acrossAxis(kept.direction, unitOr(DVec3(toWorld[0]), kept.across));
}

void GltfLights::keep(PunctualLight light, const DMat4& toWorld) {
  light.direction = unitOr(-DVec3(toWorld[2]), Vec3(0, 0, -1));
  draft_->scene.lights.push_back(std::move(light));
  draft_->lightPositions.emplace_back(toWorld[3]);
}

void GltfLights::applyUnits(LightUnits units) {
  std::vector<PunctualLight>& lights = draft_->scene.lights;
  if (lights.empty()) return;
  float brightest = 0;
  for (const PunctualLight& light : lights)
    brightest = std::max(brightest, maxComponent(light.intensity));
  const LightReading reading =
      readingOf(units, model_->asset.generator, static_cast<double>(brightest));
  reading.isDoubtful ? warn("{}", reading.line) : log("{}", reading.line);
  if (!reading.isPhotometric) return;
  for (PunctualLight& light : lights) light.intensity /= static_cast<float>(kLumensPerWatt);
}

}  // namespace ninefold
