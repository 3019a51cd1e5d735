// gltf_deform.h: morph targets and joints of a glTF primitive, and its shape in the rest pose
// (deformation.h).
//
// Tangents, texture coordinates and colours morph alike. A vertex without any weight hangs on its
// first joint, as in other programs. Where a skin mirrors, its triangles are turned round, so that
// their front stays in front.
//
// Source:  glTF 2.0 specification, 3.7.2.2 and 3.7.3.
// Proved:  tests/scene/gltf_deform_test.cpp.
// Threads: pure functions.   Errors: throws Error, naming the attribute.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "common/scene/scene.h"

namespace tinygltf {
class Model;
struct Primitive;
}  // namespace tinygltf

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

// `weights`: a target whose weight is missing or 0 stays empty; null: all are read.
std::vector<MorphTarget> readTargets(const GltfVertices& vertices, const tinygltf::Primitive& from,
                                     const std::vector<double>* weights);

// Adds what targets say of other attributes than positions and normals. Missing weights are 0.
void addOtherMorphs(const GltfVertices& vertices, const tinygltf::Primitive& from,
                    const std::vector<double>& weights, Mesh& mesh);

bool isSkinned(const tinygltf::Primitive& primitive);

// The joints of all vertices; `joints`: how many the skin has.
Holds readHolds(const GltfVertices& vertices, const tinygltf::Primitive& from, size_t joints);

// The mesh then stands at the skin's place.
void applySkin(const Holds& holds, std::span<const DMat4> joints, Mesh& mesh);

}  // namespace ninefold
