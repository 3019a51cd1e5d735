// indirect_vpls.h: VPLs at all D vertices of 2^m light paths.
//
//   Phi = rho * arriving flux / (n^2 2^m)     n: index of the medium around; radiance is basic, the
//                                             particles' flux is not
//
// They also stand where a glossy S lobe is, and send on what it does: glossy_vpl.h. m is chosen so
// that the mean number of VPLs is nearest (in ratio) to the wanted one. Walks are never cut to a
// count. In a gesture m stays as the gesture found it, and there may be a second stream:
// light_streams.h.
//
// Source:  Keller 1997; Wald et al. 2002, section 4.   Proved: tests/gi (furnace, energy).
// Threads: pure functions.   Errors: none.
#pragma once

#include "common/base/counters.h"
#include "common/gi/light/transport.h"
#include "common/gi/vpl/vpl.h"

namespace ninefold {

// m for this mean number of VPLs, from a pilot of fixed size: the same on every client. -1: no path
// is needed.
int lightPathsLog2(const Transport& transport, int meanVpls);

// Adds the indirect VPLs of set k. pathsLog2: m of the first stream, at least 0.
void addIndirectVpls(const Transport& transport, const FrameKey& frame, int k, int pathsLog2,
                     VplSet& set, RayCounts& rays);

// The same of 2^pathsLog2 particles that belong to no set and no frame.
void addPilotVpls(const Transport& transport, int pathsLog2, VplSet& set, RayCounts& rays);

}  // namespace ninefold
