#include "common/scene/edit.h"

#include <algorithm>
#include <map>
#include <utility>

#include "common/base/error.h"
#include "common/scene/cover.h"
#include "common/scene/world.h"

namespace ninefold {
namespace {

constexpr double kLargest = 1e9;     // of an element of a motion
constexpr float kBrightest = 1e12f;  // of a colour with units

template <typename T, typename Key>
void mergeList(std::vector<T>& into, const std::vector<T>& later, Key T::*key) {
  std::map<Key, T> all;
  for (const T& edit : into) all[edit.*key] = edit;
  for (const T& edit : later) all[edit.*key] = edit;
  into.clear();
  for (const auto& entry : all) into.push_back(entry.second);
}

template <typename T>
void checkIndex(const char* what, uint32_t index, const std::vector<T>& list) {
  if (index >= list.size()) fail("edit: {} {} does not exist", what, index);
}

void checkNumber(const char* what, float value, float low, float high) {
  if (!(value >= low && value <= high))
    fail("edit: {} is {}, must be {} to {}", what, value, low, high);
}

void checkColor(const char* what, Vec3 c, float high) {
  for (int i = 0; i < 3; ++i) checkNumber(what, c[i], 0, high);
}

void checkMotion(const DMat4& m) {
  if (!isPlacement(m)) fail("edit: a motion is not finite, affine and invertible");
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 3; ++row)
      if (std::abs(m[column][row]) > kLargest) fail("edit: a motion goes too far");
}

}  // namespace

LightEdit editOf(const Scene& scene, uint32_t light) {
  const PunctualLight& l = scene.lights[light];
  return {light, l.position, l.direction, l.intensity, l.across};
}

MaterialEdit editOfMaterial(const Scene& scene, uint32_t material) {
  const Material& m = scene.materials[material];
  return {material, m.baseColor, m.metallic, m.roughness, m.transmission, m.ior, m.emission};
}

void merge(SceneEdit& into, const SceneEdit& later) {
  mergeList(into.objects, later.objects, &ObjectEdit::node);
  mergeList(into.lights, later.lights, &LightEdit::light);
  mergeList(into.materials, later.materials, &MaterialEdit::material);
  mergeList(into.shapes, later.shapes, &ShapeEdit::where);
}

void EditsSoFar::add(const SceneEdit& edit, bool isMoving) {
  merge(moving, edit);
  if (!isMoving) merge(settled, std::exchange(moving, {}));
}

void checkEdit(const Scene& scene, const SceneEdit& edit) {
  for (const ObjectEdit& object : edit.objects) {
    const auto isOf = [&](const Instance& instance) { return instance.node == object.node; };
    if (!std::ranges::any_of(scene.instances, isOf))
      fail("edit: object {} does not exist", object.node);
    checkMotion(object.motion);
  }
  for (const LightEdit& light : edit.lights) {
    checkIndex("light", light.light, scene.lights);
    checkColor("a light's intensity", light.intensity, kBrightest);
    if (!isFinite(light.position) || maxComponent(glm::abs(light.position)) > kLargest)
      fail("edit: a light is too far away");
    if (!(std::abs(glm::length(light.direction) - 1) < 1e-3f))
      fail("edit: a light's direction is not of length 1");
    if (scene.lights[light.light].kind == LightKind::goniometric &&
        !(std::abs(glm::length(light.across) - 1) < 1e-3f &&
          glm::length(glm::cross(light.across, light.direction)) > 1e-3f))
      fail("edit: where a light's profile begins is not of length 1, or along its axis");
  }
  for (const MaterialEdit& m : edit.materials) {
    checkIndex("material", m.material, scene.materials);
    checkColor("a base colour", m.baseColor, 1);
    checkColor("an emission", m.emission, kBrightest);
    checkNumber("metallic", m.metallic, 0, 1);
    checkNumber("roughness", m.roughness, 0, 1);
    checkNumber("transmission", m.transmission, 0, 1);
    checkNumber("the index of refraction", m.ior, 1, 10);
  }
  checkShapes(scene, edit.shapes);
}

std::vector<bool> movedInstances(const Scene& scene, const SceneEdit& all) {
  std::vector<bool> moved(scene.instances.size(), false);
  for (size_t i = 0; i < moved.size(); ++i) {
    const Instance& instance = scene.instances[i];
    for (const ObjectEdit& object : all.objects)
      if (instance.node == object.node) moved[i] = true;
    for (const ShapeEdit& shape : all.shapes)
      if (static_cast<uint32_t>(instance.mesh) == shape.where.mesh) moved[i] = true;
  }
  return moved;
}

Scene edited(const Scene& asRead, const SceneEdit& all, const Scene* before) {
  Scene scene = asRead;
  reshape(scene, all.shapes, before);
  for (const LightEdit& e : all.lights) {
    PunctualLight& light = scene.lights[e.light];
    light.position = e.position, light.direction = e.direction, light.intensity = e.intensity;
    if (light.kind == LightKind::goniometric) light.across = acrossAxis(e.direction, e.across);
  }
  for (const MaterialEdit& e : all.materials) {
    Material& m = scene.materials[e.material];
    m.baseColor = e.baseColor, m.metallic = e.metallic, m.roughness = e.roughness;
    m.transmission = e.transmission, m.ior = e.ior, m.emission = e.emission;
  }
  for (const ObjectEdit& e : all.objects)
    for (Instance& instance : scene.instances)
      if (instance.node == e.node) instance.toWorld = e.motion * instance.toWorld;
  const std::vector<bool> moved = movedInstances(asRead, all);
  for (size_t i = 0; i < moved.size(); ++i)
    if (moved[i]) coverInstance(scene, i);
  return scene;
}

}  // namespace ninefold
