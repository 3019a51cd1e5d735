// gltf_compression.h: compressed geometry of a glTF file becomes plain buffers and accessors, so
// that the rest of the reader knows nothing of it.
//
//   EXT_meshopt_compression, KHR_meshopt_compression    gltf_meshopt.h
//   KHR_draco_mesh_compression                          gltf_draco.h
//
// Data that stand beside for other programs (fallback) are not read.
// Threads: reentrant.   Errors: throws Error, naming the place.
#pragma once

#include <string>
#include <string_view>

namespace tinygltf {
class Model;
}

namespace ninefold {

// The parser refuses what a compressed file may lack: data of a fallback buffer, and a buffer view
// of indices. Returns the JSON with something in their place; empty if there is nothing to change.
// `json`: of bounded size and depth (gltf_guard.h).
std::string completedJson(std::string_view json);

void decompress(tinygltf::Model& model);

}  // namespace ninefold
