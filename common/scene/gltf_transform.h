// gltf_transform.h: where glTF nodes stand: a matrix, or scale then rotation then translation; and
// the copies of EXT_mesh_gpu_instancing.
// Threads: const.   Errors: throws Error.
#pragma once

#include <optional>

#include "common/scene/gltf_accessor.h"

namespace tinygltf {
class Node;
class Value;
}  // namespace tinygltf

namespace ninefold {

DMat4 localMatrix(const tinygltf::Node& node);

// A motion must be invertible, so a scale of 0 becomes almost 0: an axis gets at least this share
// of the largest scale that its node ever has.
inline constexpr double kSmallestScale = 1e-5;
DVec3 liftedScale(DVec3 scale, double largest);
double maxAxis(DVec3 scale);  // without its sign

// Scale, then rotation by a quaternion (x, y, z, w) of any length but 0, then translation.
DMat4 placement(DVec3 translation, DVec4 rotation, DVec3 scale);

// v with length 1, or `otherwise` if it has none: the column of a matrix along which a camera or
// light looks.
Vec3 unitOr(DVec3 v, Vec3 otherwise);

// The matrices of a node's copies. Refers to the model.
class CopyMatrices {
 public:
  CopyMatrices(const tinygltf::Model& model, const tinygltf::Value& extension);
  size_t count() const { return count_; }
  // Invertible, unless the copy vanishes: then two axes or all have no length.
  DMat4 matrix(size_t i) const;
  bool vanishes(size_t i) const;

 private:
  DVec3 scaleOf(size_t i) const;

  std::optional<GltfAccessor> translation_, rotation_, scale_;
  size_t count_ = 0;
};

}  // namespace ninefold
