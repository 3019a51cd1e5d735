#include "common/scene/gltf_accessor.h"

#include <tiny_gltf.h>

#include <cstring>

#include "common/base/error.h"

namespace ninefold {
namespace {

constexpr int kMatrix = 16;  // components
constexpr size_t kMaxStride = 1 << 16;
constexpr size_t kMaxZeros = 1 << 20;  // elements of an accessor without a buffer view

size_t sizeOfComponent(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return 0;
  }
}

int componentsOf(int type) {
  switch (type) {
    case TINYGLTF_TYPE_SCALAR:
      return 1;
    case TINYGLTF_TYPE_VEC2:
      return 2;
    case TINYGLTF_TYPE_VEC3:
      return 3;
    case TINYGLTF_TYPE_VEC4:
      return 4;
    case TINYGLTF_TYPE_MAT4:
      return kMatrix;
    default:
      return 0;
  }
}

template <typename T>
T load(const unsigned char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

float loadComponent(const unsigned char* bytes, int type, bool normalized) {
  const auto integer = [normalized](auto value, float largest) {
    const auto v = static_cast<float>(value);
    return normalized ? std::max(v / largest, -1.0f) : v;
  };
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return integer(load<int8_t>(bytes), 127);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return integer(load<uint8_t>(bytes), 255);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return integer(load<int16_t>(bytes), 32767);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return integer(load<uint16_t>(bytes), 65535);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return integer(load<uint32_t>(bytes), 4294967295.0f);
    default:
      return load<float>(bytes);
  }
}

uint32_t loadIndex(const unsigned char* bytes, int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return load<uint8_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load<uint16_t>(bytes);
    default:
      return load<uint32_t>(bytes);
  }
}

bool isUnsignedType(int type) {
  return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
         type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
         type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

}  // namespace

BytesOfView bytesOfView(const tinygltf::Model& model, int view, const std::string& what) {
  if (view < 0 || static_cast<size_t>(view) >= model.bufferViews.size())
    fail("{}: buffer view {} does not exist", what, view);
  const tinygltf::BufferView& v = model.bufferViews[static_cast<size_t>(view)];
  if (v.buffer < 0 || static_cast<size_t>(v.buffer) >= model.buffers.size())
    fail("{}: buffer {} of buffer view {} does not exist", what, v.buffer, view);
  const auto& data = model.buffers[static_cast<size_t>(v.buffer)].data;
  if (v.byteOffset > data.size() || v.byteLength > data.size() - v.byteOffset)
    fail("{}: buffer view {} ends beyond its buffer of {} bytes", what, view, data.size());
  if (v.byteStride > kMaxStride) fail("{}: the stride of buffer view {} is too large", what, view);
  return {data.data() + v.byteOffset, v.byteLength, v.byteStride};
}

GltfAccessor::GltfAccessor(const tinygltf::Model& model, int accessor, int components,
                           std::string what)
    : what_(std::move(what)) {
  if (accessor < 0 || static_cast<size_t>(accessor) >= model.accessors.size())
    fail("{}: accessor {} does not exist", what_, accessor);
  const tinygltf::Accessor& a = model.accessors[static_cast<size_t>(accessor)];
  what_ += " (accessor " + std::to_string(accessor) + ")";
  count_ = a.count, components_ = componentsOf(a.type), normalized_ = a.normalized;
  if (components_ < components || (components_ == kMatrix && components != kMatrix))
    fail("{}: has {} components, {} are needed", what_, components_, components);
  if (sizeOfComponent(a.componentType) == 0)
    fail("{}: component type {} is not part of glTF 2.0", what_, a.componentType);
  base_.type = a.componentType;
  if (a.bufferView >= 0)
    base_ = checkedArray(model, a.bufferView, a.byteOffset, a.count, a.componentType, components_);
  else if (a.count > kMaxZeros)
    fail("{}: claims {} elements but has no data", what_, a.count);
  if (a.sparse.isSparse) readSparse(model, accessor);
}

GltfAccessor::Array GltfAccessor::checkedArray(const tinygltf::Model& model, int view,
                                               size_t offset, size_t count, int type,
                                               int components) const {
  const BytesOfView bytes = bytesOfView(model, view, what_);
  const size_t element = sizeOfComponent(type) * static_cast<size_t>(components);
  const size_t stride = bytes.stride == 0 ? element : bytes.stride;
  if (stride < element) fail("{}: stride {} is less than an element", what_, stride);
  const bool fits = count == 0 || (offset <= bytes.size && element <= bytes.size - offset &&
                                   count - 1 <= (bytes.size - offset - element) / stride);
  if (!fits)
    fail("{}: {} elements from byte {} end beyond buffer view {} of {} bytes", what_, count, offset,
         view, bytes.size);
  return {bytes.data + offset, stride, type};
}

void GltfAccessor::readSparse(const tinygltf::Model& model, int accessor) {
  const auto& sparse = model.accessors[static_cast<size_t>(accessor)].sparse;
  const int type = sparse.indices.componentType;
  if (sparse.count < 0 || static_cast<size_t>(sparse.count) > count_ || !isUnsignedType(type))
    fail("{}: bad sparse indices", what_);
  sparseCount_ = static_cast<size_t>(sparse.count);
  sparseIndices_ =
      checkedArray(model, sparse.indices.bufferView, static_cast<size_t>(sparse.indices.byteOffset),
                   sparseCount_, type, 1);
  sparseValues_ =
      checkedArray(model, sparse.values.bufferView, static_cast<size_t>(sparse.values.byteOffset),
                   sparseCount_, base_.type, components_);
  for (size_t i = 0; i < sparseCount_; ++i) {
    const uint32_t here = loadIndex(sparseIndices_.data + i * sparseIndices_.stride, type);
    const bool ascends =
        i == 0 || loadIndex(sparseIndices_.data + (i - 1) * sparseIndices_.stride, type) < here;
    if (here >= count_ || !ascends)
      fail("{}: sparse index {} is out of order or range", what_, here);
  }
}

// Where element i is stored; null for a zero element.
const unsigned char* GltfAccessor::bytesOf(size_t i) const {
  size_t low = 0, high = sparseCount_;
  while (low < high) {
    const size_t middle = (low + high) / 2;
    const uint32_t at =
        loadIndex(sparseIndices_.data + middle * sparseIndices_.stride, sparseIndices_.type);
    if (at == i) return sparseValues_.data + middle * sparseValues_.stride;
    (at < i ? low : high) = at < i ? middle + 1 : middle;
  }
  return base_.data == nullptr ? nullptr : base_.data + i * base_.stride;
}

template <typename Store>
void GltfAccessor::forEachComponent(size_t i, const Store& store) const {
  const unsigned char* bytes = bytesOf(i);
  if (bytes == nullptr) return;
  const size_t step = sizeOfComponent(base_.type);
  for (int c = 0; c < components_; ++c)
    store(c, loadComponent(bytes + static_cast<size_t>(c) * step, base_.type, normalized_));
}

Vec4 GltfAccessor::element(size_t i) const {
  Vec4 value(0);
  forEachComponent(i, [&](int c, float component) { value[c] = component; });
  return value;
}

DMat4 GltfAccessor::matrix(size_t i) const {
  DMat4 value(0);
  forEachComponent(i, [&](int c, float component) { value[c / 4][c % 4] = double(component); });
  return value;
}

bool GltfAccessor::isUnsignedInteger() const { return isUnsignedType(base_.type); }

uint32_t GltfAccessor::index(size_t i) const {
  const unsigned char* bytes = bytesOf(i);
  return bytes == nullptr ? 0 : loadIndex(bytes, base_.type);
}

}  // namespace ninefold
