#include "common/scene/photon_scene.h"

#include <algorithm>

#include "common/scene/cover.h"
#include "common/scene/reader.h"
#include "common/scene/world.h"

namespace ninefold {

void addPhotonScene(Scene& scene, const Scene& simple) {
  const auto images = static_cast<int>(scene.images.size());
  const auto materials = static_cast<int>(scene.materials.size());
  const auto meshes = static_cast<int>(scene.meshes.size());
  for (const TextureImage& image : simple.images) scene.images.push_back(image);
  for (Material m : simple.materials) {
    m.emission = Vec3(0);
    for (TextureUse* use : mapsOf(m))
      if (*use) use->image += images;
    scene.materials.push_back(std::move(m));
  }
  for (Mesh mesh : simple.meshes) {
    mesh.material += materials;
    scene.meshes.push_back(std::move(mesh));
  }
  for (Instance instance : simple.instances) {
    instance.mesh += meshes;
    instance.toWorld[3] += DVec4(simple.origin - scene.origin, 0);
    scene.photonInstances.push_back(std::move(instance));
  }
  validate(scene);
}

Scene photonSceneOf(const Scene& scene) {
  Scene met = scene;
  met.instances = scene.photonInstances, met.photonInstances.clear(), met.cover = {};
  const Bounds simple = boundsOf(met);
  met.bounds.add(simple.low), met.bounds.add(simple.high);
  const auto isLamp = [&](const Instance& instance) {
    const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
    return !isBlack(scene.materials[static_cast<size_t>(mesh.material)].emission);
  };
  std::vector<Instance> lamps;
  std::ranges::copy_if(scene.instances, std::back_inserter(lamps), isLamp);
  met.instances.insert(met.instances.begin(), lamps.begin(), lamps.end());
  for (size_t i = 0; i < lamps.size(); ++i) coverInstance(met, i);
  return met;
}

}  // namespace ninefold
