// alpha_mask.h: lets rays pass through the texels of a masked material (glTF alphaMode MASK).
// Private to this folder.
// Owner: refers to its arguments.   Threads: called from any thread that traces.
#pragma once

#include "common/scene/scene.h"
#include "common/tracing/embree.h"
#include "common/tracing/geometry.h"

namespace ninefold {

struct AlphaMask {
  const Scene* scene;
  const Mesh* mesh;
  const Material* material;

  // True if a ray passes through at barycentrics (u, v).
  bool isOpen(uint32_t triangle, float u, float v) const;
};

// Makes both kinds of rays ask `mask`, which must outlive the geometry.
void attachAlphaMask(RTCGeometry geometry, const AlphaMask& mask);

}  // namespace ninefold
