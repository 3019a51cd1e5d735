// gltf_value.h: reading the untyped JSON of glTF extensions. Absent members give the default;
// members of the wrong type are errors. For the glTF reader's .cpp files only.
// Threads: pure.   Errors: throws Error, naming the member.
#pragma once

#include <tiny_gltf.h>

#include "common/base/error.h"
#include "common/math/vec.h"

namespace ninefold {

inline double numberOr(const tinygltf::Value& object, const char* key, double otherwise) {
  if (!object.IsObject() || !object.Has(key)) return otherwise;
  const tinygltf::Value& value = object.Get(key);
  if (!value.IsNumber()) fail("'{}' is not a number", key);
  return value.GetNumberAsDouble();
}

inline int integerOr(const tinygltf::Value& object, const char* key, int otherwise) {
  if (!object.IsObject() || !object.Has(key)) return otherwise;
  const tinygltf::Value& value = object.Get(key);
  if (!value.IsInt()) fail("'{}' is not an integer", key);
  return value.GetNumberAsInt();
}

// An array of n numbers.
template <typename Vector>
Vector vectorOr(const tinygltf::Value& object, const char* key, Vector otherwise) {
  if (!object.IsObject() || !object.Has(key)) return otherwise;
  const tinygltf::Value& value = object.Get(key);
  constexpr auto n = static_cast<size_t>(Vector::length());
  if (!value.IsArray() || value.ArrayLen() != n) fail("'{}' does not have {} numbers", key, n);
  Vector v;
  for (size_t i = 0; i < n; ++i) {
    const tinygltf::Value& component = value.Get(static_cast<int>(i));
    if (!component.IsNumber()) fail("'{}' does not have {} numbers", key, n);
    v[static_cast<int>(i)] = static_cast<float>(component.GetNumberAsDouble());
  }
  return v;
}

// The extension of an object of the file, or null.
template <typename Object>
const tinygltf::Value* extensionOf(const Object& object, const char* name) {
  const auto found = object.extensions.find(name);
  return found == object.extensions.end() || !found->second.IsObject() ? nullptr : &found->second;
}

}  // namespace ninefold
