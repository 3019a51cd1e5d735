#include <string>

#include "common/base/error.h"
#include "common/scene/material_check.h"
#include "common/scene/reader.h"
#include "common/scene/world.h"

namespace ninefold {
namespace {

constexpr float kSmallestRadius = 1e-6f, kLargestRadius = 1e9f;  // [m]

bool isUnit(Vec3 v) { return std::abs(glm::dot(v, v) - 1) < 1e-3f; }

bool isFiniteVector(const Vec2& v) { return std::isfinite(v.x) && std::isfinite(v.y); }
bool isFiniteVector(const Vec3& v) { return isFinite(v); }
bool isFiniteVector(const Vec4& v) { return isFinite(Vec3(v)) && std::isfinite(v.w); }

template <typename V>
void checkPerVertex(const std::vector<V>& values, const Mesh& mesh, const std::string& what,
                    const char* name) {
  if (!values.empty() && values.size() != mesh.positions.size())
    fail("{}: {} {} for {} vertices", what, values.size(), name, mesh.positions.size());
  for (const V& v : values)
    if (!isFiniteVector(v)) fail("{}: one of its {} is not a finite number", what, name);
}

void checkMesh(const Scene& scene, const Mesh& mesh, const std::string& what) {
  if (mesh.material < 0 || static_cast<size_t>(mesh.material) >= scene.materials.size())
    fail("{}: material {} does not exist", what, mesh.material);
  checkPerVertex(mesh.positions, mesh, what, "positions");
  checkPerVertex(mesh.normals, mesh, what, "normals");
  checkPerVertex(mesh.uv0, mesh, what, "texture coordinates");
  checkPerVertex(mesh.uv1, mesh, what, "texture coordinates");
  checkPerVertex(mesh.tangents, mesh, what, "tangents");
  checkPerVertex(mesh.colors, mesh, what, "colours");
  for (const Vec4& c : mesh.colors)
    if (glm::clamp(c, 0.0f, 1.0f) != c) fail("{}: one of its colours is outside of 0 to 1", what);
  for (const Vec3& n : mesh.normals)
    if (!isUnit(n)) fail("{}: one of its normals is not of unit length", what);
  for (const Triangle& t : mesh.triangles)
    if (std::max(t.x, std::max(t.y, t.z)) >= mesh.positions.size())
      fail("{}: triangle ({}, {}, {}) is out of range, there are {} vertices", what, t.x, t.y, t.z,
           mesh.positions.size());
}

void checkImages(const Scene& scene) {
  uint64_t total = 0;
  for (size_t i = 0; i < scene.images.size(); ++i) {
    const TextureImage& image = scene.images[i];
    if (image.width < 1 || image.height < 1 || image.channels < 1 || image.channels > 4 ||
        static_cast<uint64_t>(image.width) > kMaxImageSide ||
        static_cast<uint64_t>(image.height) > kMaxImageSide)
      fail("image {}: {} x {} with {} channels is not allowed", i, image.width, image.height,
           image.channels);
    const uint64_t texels =
        static_cast<uint64_t>(image.width) * static_cast<uint64_t>(image.height);
    if (image.texels.size() != texels * static_cast<uint64_t>(image.channels))
      fail("image {}: {} bytes for {} x {} with {} channels", i, image.texels.size(), image.width,
           image.height, image.channels);
    total += texels;
  }
  if (total > kMaxTexels) fail("{} texels, more than {}: scale textures down", total, kMaxTexels);
}

uint64_t trianglesOf(const Scene& scene, const std::vector<Instance>& instances) {
  uint64_t triangles = 0;
  for (size_t i = 0; i < instances.size(); ++i) {
    const Instance& instance = instances[i];
    if (instance.mesh < 0 || static_cast<size_t>(instance.mesh) >= scene.meshes.size())
      fail("instance {}: mesh {} does not exist", i, instance.mesh);
    if (!isPlacement(instance.toWorld)) fail("instance {}: its matrix cannot be inverted", i);
    triangles += scene.meshes[static_cast<size_t>(instance.mesh)].triangles.size();
  }
  return triangles;
}

void checkInstances(const Scene& scene) {
  const size_t count = scene.instances.size() + scene.photonInstances.size();
  if (count > kMaxInstances)
    fail("{} instances, more than {}: merge objects", count, kMaxInstances);
  const uint64_t seen = trianglesOf(scene, scene.instances);
  const uint64_t triangles = seen + trianglesOf(scene, scene.photonInstances);
  if (seen == 0) fail("no geometry: the scene has no triangle to show");
  if (triangles > kMaxTriangles)
    fail("{} triangles, more than {}: simplify the scene", triangles, kMaxTriangles);
}

void checkLights(const Scene& scene) {
  for (size_t i = 0; i < scene.lights.size(); ++i) {
    const PunctualLight& light = scene.lights[i];
    if (light.kind > LightKind::goniometric) fail("light {}: unknown kind", i);
    if (!isFinite(light.position)) fail("light {}: its position is not a finite number", i);
    if (!isUnit(light.direction)) fail("light {}: its direction is not of unit length", i);
    const Vec3 I = light.intensity;
    if (!isFinite(I) || I.x < 0 || I.y < 0 || I.z < 0)
      fail("light {}: its intensity must be at least 0 and finite", i);
    const bool cone = light.innerCone >= 0 && light.innerCone <= light.outerCone &&
                      light.outerCone <= 0.5f * kPi + 1e-4f;
    if (!cone) fail("light {}: its cone must have 0 <= inner <= outer <= pi/2", i);
    if (light.kind != LightKind::goniometric) continue;
    if (light.profile < 0 || static_cast<size_t>(light.profile) >= scene.profiles.size())
      fail("light {}: profile {} does not exist", i, light.profile);
    if (!isUnit(light.across) || !(std::abs(glm::dot(light.across, light.direction)) < 1e-3f))
      fail("light {}: where its profile begins is not a unit vector across its axis", i);
  }
}

void checkProfiles(const Scene& scene) {
  size_t values = 0;
  for (size_t i = 0; i < scene.profiles.size(); ++i) {
    const LightProfile& profile = scene.profiles[i];
    checkProfile(profile, "light profile " + std::to_string(i) + " '" + profile.name + "'");
    values += profile.values.size();
  }
  if (values > kMaxProfileValues)
    fail("light profiles of {} values, more than {}: use fewer", values, kMaxProfileValues);
}

void checkCameras(const Scene& scene) {
  if (scene.cameras.empty()) fail("no camera");
  for (size_t i = 0; i < scene.cameras.size(); ++i) {
    const Camera& camera = scene.cameras[i];
    if (!isFinite(camera.eye) || !isUnit(camera.forward) || !isFinite(camera.up))
      fail("camera {} '{}': its place or direction is not finite", i, camera.name);
    if (!(glm::length(glm::cross(camera.forward, camera.up)) > 1e-6f))
      fail("camera {} '{}': its up direction is parallel to its view", i, camera.name);
    if (!(camera.verticalFov > 0 && camera.verticalFov < kPi))
      fail("camera {} '{}': its field of view must lie between 0 and 180 degrees", i, camera.name);
    if (!(camera.orthographicHeight >= 0 && camera.orthographicHeight <= kLargestFilm))
      fail("camera {} '{}': the height of its picture must lie between 0 and {:g}", i, camera.name,
           kLargestFilm);
  }
}

void checkBounds(const Scene& scene) {
  const float R = scene.bounds.radius();
  if (!isFinite(scene.bounds.low) || !isFinite(scene.bounds.high) ||
      !(R >= kSmallestRadius && R <= kLargestRadius))
    fail("the scene's radius is {} m, it must lie between {} and {}: scale it", R, kSmallestRadius,
         kLargestRadius);
  const DVec3 o = scene.origin;
  if (!std::isfinite(o.x + o.y + o.z)) fail("the scene's origin is not a finite number");
}

}  // namespace

void validate(const Scene& scene) {
  checkImages(scene);
  for (size_t i = 0; i < scene.materials.size(); ++i)
    checkMaterial(scene, scene.materials[i],
                  "material " + std::to_string(i) + " '" + scene.materials[i].name + "'");
  for (size_t i = 0; i < scene.meshes.size(); ++i)
    checkMesh(scene, scene.meshes[i],
              "mesh " + std::to_string(i) + " '" + scene.meshes[i].name + "'");
  checkInstances(scene);
  checkProfiles(scene);
  checkLights(scene);
  checkCameras(scene);
  if (!isFinite(scene.environment) || glm::any(glm::lessThan(scene.environment, Vec3(0))))
    fail("the environment must be at least 0 and finite");
  checkBounds(scene);
}

}  // namespace ninefold
