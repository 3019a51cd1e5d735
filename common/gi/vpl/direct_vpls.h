// direct_vpls.h: VPLs on the lamps: N samples of the emitters in proportion to power.
//
// N = 0: no lamp lights the first D vertex of an eye path. Those further on, which the compensation
// meets, are lit by as many as by default.
// Equal punctual ones are merged into one. In a gesture N stays as the gesture found it, and there
// may be a second stream: light_streams.h.
//
// Source:  Keller 1997; Wald et al. 2002, section 4.
// Proved:  tests/gi (polygon light, point, spot, sun).
// Threads: pure function.   Errors: none.
#pragma once

#include "common/gi/light/minor_lamps.h"
#include "common/gi/light/transport.h"
#include "common/gi/vpl/vpl.h"

namespace ninefold {

// Adds the direct VPLs of set k: `times` as many as the settings say, at least once. Samples of
// lamps that are left out bring none.
void addDirectVpls(const Transport& transport, const FrameKey& frame, int k, int times,
                   std::vector<Vpl>& vpls, const MinorLamps& leftOut = {});

}  // namespace ninefold
