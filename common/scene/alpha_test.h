// alpha_test.h: where a masked material (glTF alphaMode MASK) has a hole.
// Threads: pure.   Errors: none for valid scenes.
#pragma once

#include "common/scene/scene.h"

namespace ninefold {

// Whether light passes through the mesh at barycentrics (u, v) of a triangle. Only masked materials
// have such places.
bool isOpenAt(const Scene& scene, const Mesh& mesh, uint32_t triangle, float u, float v);

}  // namespace ninefold
