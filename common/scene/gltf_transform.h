// gltf_transform.h: where glTF nodes stand: a matrix, or scale then rotation then translation; and
// the copies of EXT_mesh_gpu_instancing.
// Errors: throws Error.
// Threads: const.
#pragma once

#include <optional>

#include "common/scene/gltf_accessor.h"

namespace tinygltf {
class Node;
class Value;
}  // namespace tinygltf

namespace ninefold {

DMat4 localMatrix(const tinygltf::Node& node);

// Refers to the model.
class CopyMatrices {
 public:
  CopyMatrices(const tinygltf::Model& model, const tinygltf::Value& extension);
  size_t count() const { return count_; }
  DMat4 matrix(size_t i) const;

 private:
  std::optional<GltfAccessor> translation_, rotation_, scale_;
  size_t count_ = 0;
};

}  // namespace ninefold
