// gltf_writer.h: a scene to a binary glTF file, with the extensions that the reader knows. Reading
// it back gives the same values, coordinates to an ulp.
//
// Instances of one node become one node with a mesh of several primitives; copies of
// EXT_mesh_gpu_instancing become nodes. Left out: light from outside, and animations.
//
// Proved:  tests/scene/gltf_writer_test.cpp.
// Threads: pure, but for the file.   Errors: throws Error that names the file.
#pragma once

#include <string>

#include "common/scene/scene.h"

namespace ninefold {

// `path` ends in .glb; the file is whole or not there.
void writeGltf(const std::string& path, const Scene& scene);

}  // namespace ninefold
