// deformation.h: the shape of a mesh after its morph targets and its skin, in this order.
//
//   p' = p + sum_k weight_k dp_k,  n' = n + sum_k weight_k dn_k
//   p" = M p',  n" = normalize(M^-T n')
//   M  = sum_i w_i M_i / sum_i w_i                                     over the joints of a vertex
//   M_i = world(joint_i) inverseBind_i        takes vertices of a mesh to where joint i holds them
//
// Source:  glTF 2.0 specification, 3.7.2.2 and 3.7.3.
// Proved:  tests/scene/gltf_deform_test.cpp.
// Threads: plain data, pure functions.   Errors: none.
#pragma once

#include <span>
#include <vector>

#include "common/scene/animated_node.h"

namespace ninefold {

// What weight 1 adds: empty, or one for each vertex.
struct MorphTarget {
  std::vector<Vec3> positions, normals;
};

// Which joints hold the vertices. Empty: no skin.
struct Holds {
  struct Hold {
    uint32_t joint;
    float weight;  // > 0
  };
  std::vector<size_t> ends;  // by vertex; its holds begin where those of the one before end
  std::vector<Hold> holds;   // at least one for each vertex

  bool empty() const { return ends.empty(); }
  Holds of(const std::vector<uint32_t>& vertices) const;  // of these alone, in their order
  DMat4 matrixOf(size_t vertex, std::span<const DMat4> joints) const;
};

struct Joint {
  int node = 0;
  int mover = -1;  // index into Scene::animated; -1: it stands still
  DMat4 world{1};  // in the file's rest pose, in file coordinates
  DMat4 inverseBind{1};
};

// The mesh stands at `place`, without any turn: near the first joint, so that vertices far from the
// file's origin lose nothing when they become floats.
struct Skin {
  DVec3 place{0};
  std::vector<Joint> joints;  // at least one
};

// translate(-place) M_i. movers: world matrices of Scene::animated at some time; may be empty where
// no joint moves.
std::vector<DMat4> jointMatrices(const Skin& skin, std::span<const DMat4> movers = {});

// A mesh of the scene whose shape the animation changes. The wire does not carry it: what travels
// is the shapes that come of it.
struct AnimatedShape {
  int mesh = 0;     // index into Scene::meshes
  int node = 0;     // of the file, for messages
  size_t flat = 0;  // triangles that were left out, as they have no area in the rest pose
  std::vector<Vec3> positions;  // before morphs and skin; one for each vertex of the mesh
  std::vector<Vec3> normals;    // likewise, or empty
  std::vector<MorphTarget> targets;
  std::vector<AnimationTrack> weights;  // one for each target, value in x
  Holds holds;
  int skin = -1;  // index into Scene::skins; -1: none
};

// Adds the targets. Missing weights are 0; `normals` may be empty.
void addMorphs(const std::vector<MorphTarget>& targets, std::span<const double> weights,
               std::vector<Vec3>& positions, std::vector<Vec3>& normals);

// The inverse transpose of M times the size of its determinant, which flat matrices have too.
DMat3 normalMatrix(const DMat3& m);

}  // namespace ninefold
