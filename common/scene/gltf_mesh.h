// gltf_mesh.h: the triangles of glTF meshes. A mesh of the file with several primitives becomes
// several meshes of the scene. Each is read when the first node asks, once for each way of
// deforming it.
// Owner: refers to model, scene, materials.   Threads: one.
// Errors: throws Error, naming mesh and primitive.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "common/scene/gltf_animation.h"
#include "common/scene/gltf_deform.h"
#include "common/scene/gltf_material.h"
#include "common/scene/gltf_skin.h"

namespace tinygltf {
struct Primitive;
}

namespace ninefold {

struct GltfShape {
  int mesh = -1;               // in scene.meshes
  std::optional<DVec3> place;  // where it stands, if a skin decides that
};

class GltfMeshes {
 public:
  GltfMeshes(const GltfFile& file, const GltfAnimations& animations, Scene& scene)
      : model_(file.model.get()),
        animations_(&animations),
        scene_(&scene),
        materials_(file, scene),
        skins_(*model_, scene) {}

  // What a node shows, by its mesh, skin and morph weights; empty if there are no triangles. What
  // an animation may deform goes to scene.shapes, too.
  const std::vector<GltfShape>& use(int node);

  // Logs, once each, what could not be taken over from all meshes so far.
  void warnOfLosses() const;

 private:
  // Which deformed mesh: without weights it is as it was modelled.
  struct Use {
    int mesh, skin;
    std::vector<double> weights;
    int morphedBy;  // the node whose weights are animated; -1: none
    auto operator<=>(const Use&) const = default;
  };
  Use useOf(int node) const;
  void readPrimitive(const tinygltf::Primitive& from, const Use& use, int node,
                     const std::string& what, GltfShape& shape, Mesh& mesh);
  // Brings the mesh into its rest pose. What an animation needs for other poses is the result.
  std::optional<AnimatedShape> deform(const tinygltf::Primitive& from, const Use& use,
                                      const GltfVertices& vertices, GltfShape& shape, Mesh& mesh);
  void keep(AnimatedShape shape, int node, size_t flat, const std::vector<uint32_t>& kept);
  std::vector<Triangle> trianglesOf(const tinygltf::Primitive& from, size_t vertices,
                                    const std::string& what);
  bool lacksCoordinates(const Mesh& mesh) const;

  const tinygltf::Model* model_;
  const GltfAnimations* animations_;
  Scene* scene_;
  GltfMaterials materials_;
  GltfSkins skins_;
  std::map<Use, std::vector<GltfShape>> known_;
  uint64_t triangles_ = 0, targetVertices_ = 0;
  size_t skippedPrimitives_ = 0, flatTriangles_ = 0, withoutCoordinates_ = 0;
};

}  // namespace ninefold
