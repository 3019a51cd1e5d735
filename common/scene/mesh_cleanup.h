// mesh_cleanup.h: what both readers do to a mesh before it becomes part of a Scene.
// Threads: pure functions.
#pragma once

#include <string>

#include "common/scene/scene.h"

namespace ninefold {

// Renumbers the vertices so that only those that the triangles use are left, in ascending order;
// returns their old numbers. Time and memory depend on the triangles alone, not on how many
// vertices there are.
std::vector<uint32_t> compactVertices(std::vector<Triangle>& triangles);

// Drops triangles of zero area and vertices that no triangle uses; makes normals and tangents unit,
// zero normals geometric, forgets tangents that are not usable, and clamps colours to [0, 1].
// Returns how many triangles were dropped. Errors: throws Error (a number that is not finite),
// naming `what`.
size_t cleanMesh(Mesh& mesh, const std::string& what);

}  // namespace ninefold
