// gltf_accessor.h: checked access to the typed arrays of a glTF file: strides, sparse substitution
// and normalized integers included. All ranges are checked when the view is made; elements are
// then read in place, so a count that a file claims costs nothing.
// Errors: the constructor throws Error, which names `what`. Refers to the model.
// Threads: const.
#pragma once

#include <cstdint>
#include <string>

#include "common/math/vec.h"

namespace tinygltf {
class Model;
}

namespace ninefold {

// Bytes of a buffer view, which may be anything; `what` for messages.
struct BytesOfView {
  const unsigned char* data = nullptr;
  size_t size = 0, stride = 0;  // stride 0 = packed
};
BytesOfView bytesOfView(const tinygltf::Model& model, int view, const std::string& what);

class GltfAccessor {
 public:
  // `components`: how many an element must have, at least; 16 asks for matrices.
  GltfAccessor(const tinygltf::Model& model, int accessor, int components, std::string what);

  size_t count() const { return count_; }
  int components() const { return components_; }
  // Missing components are 0. Integers as they are, or in [-1, 1] and [0, 1] if normalized.
  Vec4 element(size_t i) const;
  DMat4 matrix(size_t i) const;
  // First component of an unsigned integer accessor.
  uint32_t index(size_t i) const;
  bool isUnsignedInteger() const;
  // Integers are fractions of their largest value, also where the file forgets to say so.
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
  // store(component, value), for none of a zero element.
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
