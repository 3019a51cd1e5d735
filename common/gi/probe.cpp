// The pixel class by doing: renders a room with every kind of estimator in it by every method and
// hashes the result. Any difference in arithmetic, traversal or library that can reach a picture
// shows in the hash.
#include <bit>

#include <fmt/core.h>

#include "common/gi/whole_state.h"
#include "common/sampling/sampler.h"
#include "common/scene/methods.h"

namespace ninefold {
namespace {

Mesh quad(Vec3 origin, Vec3 u, Vec3 v, int material) {
  Mesh mesh;
  mesh.positions = {origin, origin + u, origin + u + v, origin + v};
  mesh.triangles = {Triangle(0, 1, 2), Triangle(0, 2, 3)};
  mesh.material = material;
  return mesh;
}

// An octahedron with smooth normals: curved for the shading, eight triangles for the tracer.
Mesh ball(Vec3 centre, float radius, int material) {
  Mesh mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (const float sign : {-1.0f, 1.0f}) {
      Vec3 n(0);
      n[axis] = sign;
      mesh.normals.push_back(n);
      mesh.positions.push_back(centre + radius * n);
    }
  for (uint32_t i = 0; i < 8; ++i) {
    const uint32_t x = i & 1, y = 2 + (i >> 1 & 1), z = 4 + (i >> 2 & 1);
    const bool turned = std::popcount(i) % 2 == 0;
    mesh.triangles.push_back(turned ? Triangle(x, z, y) : Triangle(x, y, z));
  }
  mesh.material = material;
  return mesh;
}

Material matte(Vec3 albedo, Vec3 emission) {
  Material m;
  m.baseColor = albedo, m.emission = emission;
  m.metallic = 0, m.specular = 0;
  return m;
}

Scene probeScene() {
  Scene scene;
  Material glass = matte(Vec3(1), Vec3(0)), metal = matte(Vec3(0.9f, 0.7f, 0.4f), Vec3(0));
  glass.specular = 1, glass.roughness = 0, glass.transmission = 1, glass.solid = true;
  metal.metallic = 1, metal.roughness = 0.3f;
  scene.materials = {matte(Vec3(0.7f, 0.5f, 0.3f), Vec3(0)), matte(Vec3(0), Vec3(8)), glass, metal};
  scene.meshes = {quad(Vec3(-1, -1, 1), Vec3(2, 0, 0), Vec3(0, 0, -2), 0),
                  quad(Vec3(-1, -1, -1), Vec3(2, 0, 0), Vec3(0, 2, 0), 0),
                  quad(Vec3(-0.4f, 0.9f, -0.5f), Vec3(0.8f, 0, 0.1f), Vec3(0, 0.1f, 0.8f), 1),
                  ball(Vec3(-0.3f, -0.4f, 0), 0.45f, 2), ball(Vec3(0.5f, -0.5f, -0.4f), 0.4f, 3)};
  for (size_t i = 0; i < scene.meshes.size(); ++i) {
    Instance instance;
    instance.mesh = instance.node = static_cast<int>(i);
    scene.instances.push_back(instance);
  }
  for (const Mesh& mesh : scene.meshes)
    for (const Vec3& p : mesh.positions) scene.bounds.add(p);
  Camera camera;
  camera.eye = Vec3(0.2f, 0.1f, 2.5f), camera.forward = glm::normalize(Vec3(-0.05f, -0.1f, -1));
  scene.cameras = {camera};
  return scene;
}

uint64_t addPlane(uint64_t hash, const std::vector<float>& plane) {
  for (const float value : plane) hash = hashWords(hash, std::bit_cast<uint32_t>(value));
  return hash;
}

uint64_t addTile(uint64_t hash, const TileResult& tile) {
  for (const LayerPlanes& layer : tile.layers) {
    for (const RgbPlane* plane :
         {&layer.reflectance, &layer.irradiance, &layer.unfiltered, &layer.normal}) {
      hash = addPlane(hash, plane->r);
      hash = addPlane(hash, plane->g);
      hash = addPlane(hash, plane->b);
    }
    hash = addPlane(hash, layer.distance);
  }
  return hash;
}

uint64_t addPicture(uint64_t hash, const Tracer& tracer, const Settings& settings) {
  const Renderer renderer(tracer, settings);
  const auto scratch = renderer.makeScratch();
  const FrameKey frame{0, 0, 0, 0.1f};
  const auto state = wholeState(renderer, settings, frame.randomization);
  TileResult tile;
  for (int phase = 0; phase < settings.interleave.sets(); ++phase) {
    const auto lights = renderer.light(frame, phase, state.get());
    renderer.render(Task{frame, 0, phase, 0}, *lights, *scratch, tile);
    hash = addTile(hash, tile);
  }
  return hash;
}

}  // namespace

std::string probeClass(Isa isa) {
  const Scene scene = probeScene();
  const Tracer tracer(scene, isa);
  Settings settings;
  settings.width = 48, settings.height = 36, settings.interleave = {2, 1}, settings.photons = 200;
  settings.photonPool = 4608, settings.fieldPhotons = 4096;
  settings.fieldDirections = 5, settings.fieldDistances = 12;
  settings.camera = scene.cameras.front();
  uint64_t hash = 0;
  for (const MethodFacts& facts : allMethods()) {
    if (facts.isChoice) continue;
    settings.method = facts.method;
    hash = addPicture(hash, tracer, settings);
  }
  return fmt::format("{:016x}", hash);
}

}  // namespace ninefold
