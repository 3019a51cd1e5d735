#include "common/scene/gltf_deform.h"

#include <tiny_gltf.h>

#include "common/base/error.h"
#include "common/scene/gltf_accessor.h"
#include "common/scene/gltf_transform.h"

namespace ninefold {
namespace {

using Target = std::map<std::string, int>;

// What a target says of an attribute, if it says anything.
std::optional<GltfAccessor> deltaOf(const GltfVertices& vertices, const Target& target,
                                    const char* name, int components) {
  const auto found = target.find(name);
  if (found == target.end()) return std::nullopt;
  return vertices.open(found->second, components, std::string("target ") + name);
}

std::vector<Vec3> vectorsOf(const GltfVertices& vertices, const Target& target, const char* name) {
  std::vector<Vec3> values;
  if (const auto delta = deltaOf(vertices, target, name, 3))
    for (const uint32_t i : vertices.kept) values.emplace_back(delta->element(i));
  return values;
}

// Adds weight times a target's attribute to the mesh's, where both have it.
template <typename V>
void add(const GltfVertices& vertices, const Target& target, const char* name, int components,
         float weight, std::vector<V>& to) {
  if (to.empty()) return;
  const auto delta = deltaOf(vertices, target, name, components);
  for (size_t i = 0; delta && i < to.size(); ++i)
    to[i] += weight * V(delta->element(vertices.kept[i]));
}

// The attributes of one set: four joints for each vertex, and how much each counts.
struct JointSet {
  GltfAccessor joints, weights;
};
std::vector<JointSet> jointSets(const GltfVertices& vertices, const tinygltf::Primitive& from) {
  std::vector<JointSet> sets;
  for (int set = 0;; ++set) {
    const auto joints = from.attributes.find("JOINTS_" + std::to_string(set));
    const auto weights = from.attributes.find("WEIGHTS_" + std::to_string(set));
    if (joints == from.attributes.end() || weights == from.attributes.end()) return sets;
    sets.push_back({vertices.open(joints->second, 4, joints->first),
                    vertices.open(weights->second, 4, weights->first)});
    sets.back().weights.takeAsNormalized();
    if (!sets.back().joints.isUnsignedInteger())
      fail("{}: its {} are not unsigned integers", vertices.what, joints->first);
  }
}

}  // namespace

GltfAccessor GltfVertices::open(int accessor, int components, const std::string& name) const {
  GltfAccessor opened(*model, accessor, components, what + " " + name);
  if (opened.count() != count)
    fail("{}: {} has {} elements for {} vertices", what, name, opened.count(), count);
  return opened;
}

std::vector<MorphTarget> readTargets(const GltfVertices& vertices, const tinygltf::Primitive& from,
                                     const std::vector<double>* weights) {
  std::vector<MorphTarget> targets(from.targets.size());
  for (size_t k = 0; k < targets.size(); ++k) {
    if (weights != nullptr && (k >= weights->size() || (*weights)[k] == 0)) continue;
    targets[k].positions = vectorsOf(vertices, from.targets[k], "POSITION");
    targets[k].normals = vectorsOf(vertices, from.targets[k], "NORMAL");
  }
  return targets;
}

void addOtherMorphs(const GltfVertices& vertices, const tinygltf::Primitive& from,
                    const std::vector<double>& weights, Mesh& mesh) {
  std::vector<Vec3> tangents(mesh.tangents.begin(), mesh.tangents.end());
  for (size_t k = 0; k < from.targets.size() && k < weights.size(); ++k) {
    const auto weight = static_cast<float>(weights[k]);
    if (weight == 0) continue;
    const Target& target = from.targets[k];
    add(vertices, target, "TANGENT", 3, weight, tangents);
    add(vertices, target, "TEXCOORD_0", 2, weight, mesh.uv0);
    add(vertices, target, "TEXCOORD_1", 2, weight, mesh.uv1);
    add(vertices, target, "COLOR_0", 3, weight, mesh.colors);
  }
  for (size_t i = 0; i < tangents.size(); ++i)
    mesh.tangents[i] = Vec4(tangents[i], mesh.tangents[i].w);
}

bool isSkinned(const tinygltf::Primitive& primitive) {
  return primitive.attributes.contains("JOINTS_0") && primitive.attributes.contains("WEIGHTS_0");
}

Holds readHolds(const GltfVertices& vertices, const tinygltf::Primitive& from, size_t joints) {
  const std::vector<JointSet> sets = jointSets(vertices, from);
  Holds read;
  const auto hold = [&](float joint, float weight) {
    if (!(double(joint) < double(joints)))
      fail("{}: joint {} does not exist, its skin has {}", vertices.what, joint, joints);
    read.holds.push_back({static_cast<uint32_t>(joint), weight});
  };
  for (const uint32_t vertex : vertices.kept) {
    const size_t before = read.holds.size();
    for (const JointSet& set : sets) {
      const Vec4 joint = set.joints.element(vertex), weights = set.weights.element(vertex);
      for (int i = 0; i < 4; ++i) {
        if (!std::isfinite(weights[i])) fail("{}: a weight is not a finite number", vertices.what);
        if (weights[i] > 0) hold(joint[i], weights[i]);
      }
    }
    if (read.holds.size() == before) hold(sets[0].joints.element(vertex).x, 1);
    read.ends.push_back(read.holds.size());
  }
  return read;
}

void applySkin(const Holds& holds, std::span<const DMat4> joints, Mesh& mesh) {
  std::vector<char> mirrored(mesh.positions.size());
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    const DMat4 m = holds.matrixOf(i, joints);
    const DMat3 linear(m);
    mirrored[i] = glm::determinant(linear) < 0;
    mesh.positions[i] = Vec3(DVec3(m * DVec4(DVec3(mesh.positions[i]), 1)));
    if (!mesh.normals.empty())
      mesh.normals[i] = unitOr(normalMatrix(linear) * DVec3(mesh.normals[i]), Vec3(0));
    if (!mesh.tangents.empty())
      mesh.tangents[i] = Vec4(unitOr(linear * DVec3(mesh.tangents[i]), Vec3(0)),
                              mirrored[i] ? -mesh.tangents[i].w : mesh.tangents[i].w);
  }
  for (Triangle& t : mesh.triangles)
    if (mirrored[t.x]) std::swap(t.y, t.z);
}

}  // namespace ninefold
