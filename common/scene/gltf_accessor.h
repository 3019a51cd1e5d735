// gltf_accessor.h: checked access to the typed arrays of a glTF file, with strides, sparse
// substitution and normalized integers. The constructor checks all ranges. Elements are then read
// in place: a count that a file claims costs nothing.
//
// Owner: refers to the model.   Threads: const.
// Errors: the constructor throws Error, which names `what`.
#pragma once

#include <cstdint>
#include <string>

#include "common/math/vec.h"

namespace tinygltf {
class Model;
}

namespace ninefold {

// The bytes of a buffer view. `view` may be any number; `what` is for messages.
struct BytesOfView {
  const unsigned char* data = nullptr;
  size_t size = 0, stride = 0;  // stride 0 = packed
};
BytesOfView bytesOfView(const tinygltf::Model& model, int view, const std::string& what);

class GltfAccessor {
 public:
  // `components`: the least number that an element must have; 16 asks for matrices.
  GltfAccessor(const tinygltf::Model& model, int accessor, int components, std::string what);

  size_t count() const { return count_; }
  int components() const { return components_; }
  // Missing components are 0. Integers are as they are or, if normalized, in [-1, 1] or [0, 1].
  Vec4 element(size_t i) const;
  DMat4 matrix(size_t i) const;
  // First component of an unsigned integer accessor.
  uint32_t index(size_t i) const;
  bool isUnsignedInteger() const;
  // From here on integers are fractions of their largest value, even if the file forgot to say so.
  void takeAsNormalized() { normalized_ = true; }

 private:
  // A run of equally spaced elements.
  struct Array {
    const unsigned char* data = nullptr;
    size_t stride = 0;
    int type = 0;
  };
  Array checkedArray(const tinygltf::Model& model, int view, size_t offset, size_t count, int type,
                     int components) const;
  void readSparse(const tinygltf::Model& model, int accessor);
  const unsigned char* bytesOf(size_t i) const;
  // Calls store(component, value) for each component of element i; never for a zero element.
  template <typename Store>
  void forEachComponent(size_t i, const Store& store) const;

  std::string what_;
  size_t count_ = 0;
  int components_ = 0;
  bool normalized_ = false;
  Array base_;  // data null: zeros, apart from the sparse elements
  size_t sparseCount_ = 0;
  Array sparseIndices_, sparseValues_;  // indices strictly ascending
};

}  // namespace ninefold
