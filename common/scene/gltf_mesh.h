// gltf_mesh.h: the triangles of glTF meshes. A mesh of the file with several primitives becomes
// several meshes of the scene. Each is read when the first node asks, once for each way of
// deforming it.
// Owner: refers to model, scene, materials.   Threads: one.
// Errors: throws Error, naming mesh and primitive.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "common/scene/gltf_deform.h"
#include "common/scene/gltf_material.h"

namespace tinygltf {
class Node;
struct Primitive;
}  // namespace tinygltf

namespace ninefold {

struct GltfShape {
  int mesh = -1;               // in scene.meshes
  std::optional<DVec3> place;  // where it stands, if a skin decides that
};

class GltfMeshes {
 public:
  GltfMeshes(const GltfFile& file, Scene& scene)
      : model_(file.model.get()), scene_(&scene), materials_(file, scene), skins_(*model_) {}

  // What a node shows, by its mesh, skin and morph weights; empty if there are no triangles.
  const std::vector<GltfShape>& use(const tinygltf::Node& node);

  // Logs, once each, what could not be taken over from all meshes so far.
  void warnOfLosses() const;

 private:
  // Which deformed mesh: without weights it is as it was modelled.
  struct Use {
    int mesh, skin;
    std::vector<double> weights;
    auto operator<=>(const Use&) const = default;
  };
  Use useOf(const tinygltf::Node& node) const;
  void readPrimitive(const tinygltf::Primitive& from, const Use& use, const std::string& what,
                     GltfShape& shape, Mesh& mesh);
  void deform(const tinygltf::Primitive& from, const Use& use, const GltfVertices& vertices,
              GltfShape& shape, Mesh& mesh);
  std::vector<Triangle> trianglesOf(const tinygltf::Primitive& from, size_t vertices,
                                    const std::string& what);
  bool lacksCoordinates(const Mesh& mesh) const;

  const tinygltf::Model* model_;
  Scene* scene_;
  GltfMaterials materials_;
  GltfSkins skins_;
  std::map<Use, std::vector<GltfShape>> known_;
  uint64_t triangles_ = 0;
  size_t skippedPrimitives_ = 0, flatTriangles_ = 0, withoutCoordinates_ = 0;
};

}  // namespace ninefold
