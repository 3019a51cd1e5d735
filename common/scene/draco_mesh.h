// draco_mesh.h: one Draco stream to a mesh. Draco takes memory for whatever a stream claims, so its
// claims are looked at as soon as they have been read:
//
//   faces, points / 3        <= kMostFacesPerByte for each byte of the stream
//   faces (1 + seams)        <= budget.faces       seams: attributes with edges of their own
//   attributes               <= kMostDracoAttributes, of at most four components
//   8 points components      <= budget.bytes
//
// Source:  Draco bitstream specification 2.2.
// Proved:  tests/scene/gltf_draco_test.cpp; tests/fuzz/scene_gltf.cpp.
// Threads: reentrant.   Errors: throws Error.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

namespace draco {
class Mesh;
}

namespace ninefold {

inline constexpr uint64_t kMostFacesPerByte = 128;  // a flat grid has 11
inline constexpr int kMostDracoAttributes = 32;

// What the streams of a file may still hold.
struct DracoBudget {
  uint64_t faces, bytes;
};

// Takes what the mesh has from the budget.
std::unique_ptr<draco::Mesh> decodeDracoMesh(std::span<const unsigned char> stream,
                                             DracoBudget& budget);

}  // namespace ninefold
