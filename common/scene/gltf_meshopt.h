// gltf_meshopt.h: buffer views compressed by meshoptimizer. Each becomes a buffer of its own:
//
//   ATTRIBUTES   count elements of byteStride bytes, then perhaps a filter over them:
//                OCTAHEDRAL unit vectors, QUATERNION, EXPONENTIAL floats
//   TRIANGLES    count indices of 2 or 4 bytes, three a triangle
//   INDICES      count indices of 2 or 4 bytes
//
// Limits, before memory is taken: kMostExpansion, and kMaxFileBytes for all views together.
// Source:  glTF extensions EXT_meshopt_compression and KHR_meshopt_compression (the same but for
//          streams of version 1 and the filter COLOR, which the library cannot decode).
// Proved:  tests/scene/gltf_meshopt_test.cpp.
// Threads: reentrant.   Errors: throws Error, naming the buffer view.
#pragma once

#include <array>
#include <cstddef>

namespace tinygltf {
class Model;
}

namespace ninefold {

inline constexpr std::array<const char*, 2> kMeshoptExtensions = {"EXT_meshopt_compression",
                                                                  "KHR_meshopt_compression"};

// The format spends at least two bits on sixteen bytes.
inline constexpr size_t kMostExpansion = 64;

void decodeMeshopt(tinygltf::Model& model);

}  // namespace ninefold
