// gltf_draco.h: primitives compressed by Draco. Their indices and the attributes that the stream
// holds become new accessors; the file's own are left as they are. What the stream does not hold
// (morph targets, say) goes by the order of its points.
//
// Limits, before memory is taken: draco_mesh.h; kMaxTriangles and kMaxFileBytes for all together.
// Source:  glTF extension KHR_draco_mesh_compression.
// Proved:  tests/scene/gltf_draco_test.cpp.
// Threads: reentrant.   Errors: throws Error, naming mesh and primitive.
#pragma once

namespace tinygltf {
class Model;
}

namespace ninefold {

inline constexpr const char* kDracoExtension = "KHR_draco_mesh_compression";

void decodeDraco(tinygltf::Model& model);

}  // namespace ninefold
