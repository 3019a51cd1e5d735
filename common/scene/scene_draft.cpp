#include "common/scene/scene_draft.h"

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/scene/emitters.h"
#include "common/scene/reader.h"
#include "common/scene/texel_ranges.h"
#include "common/scene/world.h"

namespace ninefold {
namespace {

DVec3 middleOf(const Scene& scene) {
  DVec3 low(std::numeric_limits<double>::infinity()), high = -low;
  for (const Instance& instance : scene.instances)
    for (const Vec3& p : scene.meshes[static_cast<size_t>(instance.mesh)].positions) {
      const DVec3 w(instance.toWorld * DVec4(DVec3(p), 1.0));
      low = glm::min(low, w), high = glm::max(high, w);
    }
  return 0.5 * low + 0.5 * high;
}

void moveToOrigin(SceneDraft& draft) {
  Scene& scene = draft.scene;
  scene.origin = middleOf(scene);
  if (!std::isfinite(scene.origin.x + scene.origin.y + scene.origin.z))
    fail("its coordinates are too large for numbers: scale it down");
  for (Instance& instance : scene.instances) instance.toWorld[3] -= DVec4(scene.origin, 0.0);
  for (size_t i = 0; i < scene.lights.size(); ++i)
    scene.lights[i].position = Vec3(draft.lightPositions[i] - scene.origin);
  for (size_t i = 0; i < scene.cameras.size(); ++i)
    scene.cameras[i].eye = Vec3(draft.eyes[i] - scene.origin);
  scene.bounds = boundsOf(scene);
}

// Meshes that lost all their instances would only be carried around.
bool hasGeometry(const Scene& scene) {
  return std::any_of(scene.instances.begin(), scene.instances.end(), [&](const Instance& i) {
    return !scene.meshes[static_cast<size_t>(i.mesh)].triangles.empty();
  });
}

}  // namespace

void SceneDraft::addInstance(int mesh, int node, const std::string& name, const DMat4& toWorld) {
  if (!isPlacement(toWorld)) {
    ++flatInstances;
    return;
  }
  triangles += scene.meshes[static_cast<size_t>(mesh)].triangles.size();
  if (triangles > kMaxTriangles) fail("more than {} triangles: simplify the scene", kMaxTriangles);
  if (scene.instances.size() >= kMaxInstances)
    fail("more than {} instances: merge objects", kMaxInstances);
  scene.instances.push_back({name, mesh, node, toWorld});
}

Camera framingCamera(const Bounds& bounds) {
  constexpr float kFov = 40 * kPi / 180, kMargin = 1.05f, kFlat = 0.2f;
  const Vec3 half = 0.5f * (bounds.high - bounds.low);
  Camera camera;
  camera.name = "framing";
  camera.verticalFov = kFov;
  if (half.y < kFlat * std::max(half.x, half.z)) {
    camera.forward = glm::normalize(Vec3(0, -1, -1.5f));
    camera.eye =
        bounds.centre() - kMargin * bounds.radius() / std::sin(0.5f * kFov) * camera.forward;
    return camera;
  }
  const float distance = kMargin * std::max(half.x, half.y) / std::tan(0.5f * kFov);
  camera.eye = bounds.centre() + Vec3(0, 0, half.z + std::max(distance, 0.1f * half.z));
  return camera;
}

Scene finishScene(SceneDraft draft, bool isLit) {
  Scene& scene = draft.scene;
  if (draft.flatInstances > 0)
    warn("{} objects that are scaled to nothing are left out", draft.flatInstances);
  if (!hasGeometry(scene)) fail("no geometry: the scene has no triangle to show");
  moveToOrigin(draft);
  if (scene.cameras.empty()) {
    scene.cameras.push_back(framingCamera(scene.bounds));
    const DVec3 eye = DVec3(scene.cameras[0].eye) + scene.origin;
    log("no camera in the file: looking at all of it from {:.4g},{:.4g},{:.4g}", eye.x, eye.y,
        eye.z);
  }
  validate(scene);
  keepTexelRanges(scene);
  if (!isLit && !scene.environmentMap && !Emitters::anyIn(scene)) {
    warn("no light in the file: a white environment of radiance 1 lights it");
    scene.environment = Radiance(1);
  }
  return std::move(draft.scene);
}

}  // namespace ninefold
