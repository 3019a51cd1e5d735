// gltf_mesh.h: the triangles of glTF meshes. A mesh of the file with several primitives becomes
// several meshes of the scene. Each is read once, when the first node asks for it.
// Errors: throws Error, naming mesh and primitive. Refers to model, scene, materials.
// Threads: one.
#pragma once

#include <map>
#include <vector>

#include "common/scene/gltf_material.h"

namespace tinygltf {
struct Primitive;
}

namespace ninefold {

class GltfMeshes {
 public:
  GltfMeshes(const GltfFile& file, Scene& scene)
      : model_(file.model.get()), scene_(&scene), materials_(file, scene) {}

  // Indices into scene.meshes; empty if the mesh has no triangles.
  const std::vector<int>& use(int mesh);

  // Logs, once each, what could not be taken over from all meshes so far.
  void warnOfLosses() const;

 private:
  void readPrimitive(const tinygltf::Primitive& from, const std::string& what, Mesh& mesh);
  std::vector<Triangle> trianglesOf(const tinygltf::Primitive& from, size_t vertices,
                                    const std::string& what);
  bool lacksCoordinates(const Mesh& mesh) const;

  const tinygltf::Model* model_;
  Scene* scene_;
  GltfMaterials materials_;
  std::map<int, std::vector<int>> known_;
  uint64_t triangles_ = 0;
  size_t skippedPrimitives_ = 0, flatTriangles_ = 0, deformed_ = 0, withoutCoordinates_ = 0;
};

}  // namespace ninefold
