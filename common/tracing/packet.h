// packet.h: sixteen rays through the hierarchies of a scene's parts, one after another. The nearest
// hit so far is the next part's far end, and blocked lanes drop out. Private to this folder.
//
// Without AVX-512 Embree has no 16-wide kernels: version 3 then forgets which lanes are active, and
// version 4 traces ray by ray. So the halves are made here, and both versions use their 8-wide
// kernels. Debian's Embree aborts on rays that are not finite: such lanes are left out and hit
// nothing.
//
// Threads: pure functions of their arguments.
#pragma once

#include <vector>

#include "common/tracing/part.h"
#include "common/tracing/tracer.h"

namespace ninefold {

// Coordinates of rays and of what they hit stay below this; Embree's own limit is 1.8e18.
inline constexpr float kMaxCoordinate = 1e18f;

// The lanes of `active` whose rays Embree can trace.
uint32_t traceable(const RayPacket& rays, uint32_t active);
bool traceable(Vec3 origin, Vec3 direction, float tFar);

// Fills `query` from the rays, and then with the hits of the active lanes.
void intersectPacket(const Hierarchies& parts, bool wide, bool coherent, const RayPacket& rays,
                     uint32_t active, RTCRayHit16& query);

// Sets farT of blocked active lanes to negative infinity, and returns their bits. Masks are lost.
uint32_t occludedPacket(const Hierarchies& parts, bool wide, bool coherent, uint32_t active,
                        RayPacket& rays);

}  // namespace ninefold
