#include "common/scene/gltf_deform.h"

#include <tiny_gltf.h>

#include "common/base/error.h"
#include "common/scene/gltf_accessor.h"
#include "common/scene/gltf_transform.h"

namespace ninefold {
namespace {

using Target = std::map<std::string, int>;

// Adds weight times a target's attribute to the mesh's, where both have it.
template <typename V>
void add(const GltfVertices& vertices, const Target& target, const char* name, int components,
         float weight, std::vector<V>& to) {
  const auto found = target.find(name);
  if (found == target.end() || to.empty()) return;
  const GltfAccessor delta =
      vertices.open(found->second, components, std::string("target ") + name);
  for (size_t i = 0; i < to.size(); ++i) to[i] += weight * V(delta.element(vertices.kept[i]));
}

// The joints of all vertices and how much each counts.
class Joints {
 public:
  Joints(const GltfVertices& vertices, const tinygltf::Primitive& from, const SkinPose& pose)
      : pose_(&pose), what_(&vertices.what) {
    for (int set = 0;; ++set) {
      const auto joints = from.attributes.find("JOINTS_" + std::to_string(set));
      const auto weights = from.attributes.find("WEIGHTS_" + std::to_string(set));
      if (joints == from.attributes.end() || weights == from.attributes.end()) break;
      joints_.push_back(vertices.open(joints->second, 4, joints->first));
      weights_.push_back(vertices.open(weights->second, 4, weights->first));
      weights_.back().takeAsNormalized();
      if (!joints_.back().isUnsignedInteger())
        fail("{}: its {} are not unsigned integers", vertices.what, joints->first);
    }
  }

  DMat4 matrixOf(uint32_t vertex) const {
    DMat4 sum(0);
    double total = 0;
    for (size_t set = 0; set < joints_.size(); ++set) {
      const Vec4 joints = joints_[set].element(vertex), weights = weights_[set].element(vertex);
      for (int i = 0; i < 4; ++i) {
        if (!std::isfinite(weights[i])) fail("{}: a weight is not a finite number", *what_);
        if (!(weights[i] > 0)) continue;
        sum += double(weights[i]) * joint(joints[i]);
        total += double(weights[i]);
      }
    }
    return total > 0 ? sum / total : joint(joints_[0].element(vertex).x);
  }

 private:
  const DMat4& joint(float index) const {
    const size_t count = pose_->joints.size();
    if (!(double(index) < double(count)))
      fail("{}: joint {} does not exist, its skin has {}", *what_, index, count);
    return pose_->joints[static_cast<size_t>(index)];
  }

  const SkinPose* pose_;
  const std::string* what_;
  std::vector<GltfAccessor> joints_, weights_;  // by set
};

// The inverse transpose times the determinant's size, which flat matrices have too.
DMat3 normalMatrix(const DMat3& m, bool mirrors) {
  const DMat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  return mirrors ? -cofactors : cofactors;
}

}  // namespace

GltfAccessor GltfVertices::open(int accessor, int components, const std::string& name) const {
  GltfAccessor opened(*model, accessor, components, what + " " + name);
  if (opened.count() != count)
    fail("{}: {} has {} elements for {} vertices", what, name, opened.count(), count);
  return opened;
}

void addMorphs(const GltfVertices& vertices, const tinygltf::Primitive& from,
               const std::vector<double>& weights, Mesh& mesh) {
  std::vector<Vec3> tangents(mesh.tangents.begin(), mesh.tangents.end());
  for (size_t k = 0; k < from.targets.size() && k < weights.size(); ++k) {
    const auto weight = static_cast<float>(weights[k]);
    if (weight == 0) continue;
    const Target& target = from.targets[k];
    add(vertices, target, "POSITION", 3, weight, mesh.positions);
    add(vertices, target, "NORMAL", 3, weight, mesh.normals);
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

void applySkin(const GltfVertices& vertices, const tinygltf::Primitive& from, const SkinPose& pose,
               Mesh& mesh) {
  const Joints joints(vertices, from, pose);
  std::vector<char> mirrored(mesh.positions.size());
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    const DMat4 m = joints.matrixOf(vertices.kept[i]);
    const DMat3 linear(m);
    mirrored[i] = glm::determinant(linear) < 0;
    mesh.positions[i] = Vec3(DVec3(m * DVec4(DVec3(mesh.positions[i]), 1)));
    if (!mesh.normals.empty())
      mesh.normals[i] = unitOr(normalMatrix(linear, mirrored[i]) * DVec3(mesh.normals[i]), Vec3(0));
    if (!mesh.tangents.empty())
      mesh.tangents[i] = Vec4(unitOr(linear * DVec3(mesh.tangents[i]), Vec3(0)),
                              mirrored[i] ? -mesh.tangents[i].w : mesh.tangents[i].w);
  }
  for (Triangle& t : mesh.triangles)
    if (mirrored[t.x]) std::swap(t.y, t.z);
}

}  // namespace ninefold
