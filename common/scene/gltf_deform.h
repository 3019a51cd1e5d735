// gltf_deform.h: the shape of a glTF primitive after its morph targets and its skin, in this order.
//
//   a' = a + sum_k weight_k target_k                                   of every attribute a
//   p' = M p,  n' = normalize(M^-T n),  t' = normalize(M t)
//   M  = sum_i w_i M_i / sum_i w_i                                     over the joints of a vertex
//
// A vertex without any weight hangs on its first joint, as in other programs. Where a skin mirrors,
// its triangles are turned round, so that their front stays in front.
//
// Source:  glTF 2.0 specification, 3.7.2.2 and 3.7.3.
// Proved:  tests/scene/gltf_deform_test.cpp.
// Threads: pure functions.   Errors: throws Error, naming the attribute.
#pragma once

#include <string>
#include <vector>

#include "common/scene/gltf_skin.h"
#include "common/scene/scene.h"

namespace tinygltf {
struct Primitive;
}

namespace ninefold {

class GltfAccessor;

// The vertices of a primitive that became those of a mesh.
struct GltfVertices {
  const tinygltf::Model* model;
  size_t count;                // of the primitive
  std::vector<uint32_t> kept;  // their numbers among these
  std::string what;            // for messages

  // Opens an accessor and checks that it has one element for each of `count`.
  GltfAccessor open(int accessor, int components, const std::string& name) const;
};

// Adds the morph targets of `from` to the mesh. Missing weights are 0.
void addMorphs(const GltfVertices& vertices, const tinygltf::Primitive& from,
               const std::vector<double>& weights, Mesh& mesh);

bool isSkinned(const tinygltf::Primitive& primitive);

// The mesh then stands at pose.place, without any turn.
void applySkin(const GltfVertices& vertices, const tinygltf::Primitive& from, const SkinPose& pose,
               Mesh& mesh);

}  // namespace ninefold
