// mesh_cleanup.h: what both readers do to a mesh before it becomes part of a Scene.
// Threads: pure functions.
#pragma once

#include <string>

#include "common/scene/scene.h"

namespace ninefold {

// Renumbers the vertices: only those that the triangles use are left, in ascending order. Returns
// their old numbers. Time and memory depend on the number of triangles alone.
std::vector<uint32_t> compactVertices(std::vector<Triangle>& triangles);

// Drops triangles of zero area and vertices that no triangle uses. Makes normals and tangents unit
// and zero normals geometric, forgets unusable tangents, and clamps colours to [0, 1]. Returns how
// many triangles were dropped; `kept`: the old numbers of the vertices that are left. Throws Error,
// naming `what`, for a number that is not finite.
size_t cleanMesh(Mesh& mesh, const std::string& what, std::vector<uint32_t>* kept = nullptr);

// The values of these vertices alone; no values stay none.
template <typename V>
void keepOnly(std::vector<V>& values, const std::vector<uint32_t>& kept) {
  if (values.empty()) return;
  for (size_t i = 0; i < kept.size(); ++i) values[i] = values[kept[i]];
  values.resize(kept.size());
}

}  // namespace ninefold
