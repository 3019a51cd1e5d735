// straight_light.h: the share of light that passes straight through blended surfaces and smooth
// thin walls.
//
//   V(x, y) = product of straightPass over what the segment meets      0 if anything else blocks it
//
// Light that is not bent is no caustic. Shadow rays find what lights a point through a pane as they
// find what lights it without one. Photons that have only passed straight on are not stored
// (light_path.h). The media on both sides are the same: solids bend, so they block here.
//
// Only blocked segments are walked, surface by surface, and only those that meet the bounds of
// something that lets light pass.
//
// Threads: const, reentrant.   Errors: none.   Proved: tests/gi/straight_light_test.cpp.
#pragma once

#include "common/gi/light/transport.h"

namespace ninefold {

// V of the segment origin + t * segment, t in [0, tFar], which something blocks. Black if it meets
// more surfaces than specular-depth. Adds its rays to `rays`.
Vec3 straightVisibility(const Transport& transport, Vec3 origin, Vec3 segment, float tFar,
                        uint64_t& rays);

}  // namespace ninefold
