// gltf_bytes.h: small glTF files made in code: a triangle to vary, and the binary container.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace ninefold {

using Bytes = std::vector<unsigned char>;

template <typename T>
void append(Bytes& bytes, const std::vector<T>& values) {
  const size_t at = bytes.size();
  bytes.resize(at + values.size() * sizeof(T));
  std::memcpy(bytes.data() + at, values.data(), values.size() * sizeof(T));
}

// A .glb of the given JSON and binary chunk, both padded to four bytes as the format wants it.
inline Bytes glb(std::string json, Bytes binary) {
  while (json.size() % 4 != 0) json += ' ';
  while (binary.size() % 4 != 0) binary.push_back(0);
  Bytes file;
  const auto total = static_cast<uint32_t>(12 + 8 + json.size() + 8 + binary.size());
  append<uint32_t>(file, {0x46546C67, 2, total, static_cast<uint32_t>(json.size()), 0x4E4F534A});
  file.insert(file.end(), json.begin(), json.end());
  append<uint32_t>(file, {static_cast<uint32_t>(binary.size()), 0x004E4942});
  file.insert(file.end(), binary.begin(), binary.end());
  return file;
}

// `text` with its only or first `from` replaced; fails the test if there is none.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << "the test's own JSON lacks " << from;
  if (at != std::string::npos) text.replace(at, from.size(), to);
  return text;
}

// One triangle (0,0,0) (2,0,0) (0,2,0) with material 0.
inline const std::string kTriangleJson = R"({
  "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
  "nodes": [{"name": "thing", "mesh": 0}],
  "meshes": [{"name": "shape", "primitives": [
    {"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
  "materials": [{"name": "paint"}],
  "accessors": [
    {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
    {"bufferView": 1, "componentType": 5125, "count": 3, "type": "SCALAR"}],
  "bufferViews": [
    {"buffer": 0, "byteOffset": 0, "byteLength": 36},
    {"buffer": 0, "byteOffset": 36, "byteLength": 12}],
  "buffers": [{"byteLength": 48}]
})";

inline Bytes triangleBytes() {
  Bytes bytes;
  append<float>(bytes, {0, 0, 0, 2, 0, 0, 0, 2, 0});
  append<uint32_t>(bytes, {0, 1, 2});
  return bytes;
}

inline Bytes triangleGlb(const std::string& json = kTriangleJson) {
  return glb(json, triangleBytes());
}

}  // namespace ninefold
