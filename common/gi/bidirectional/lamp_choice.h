// lamp_choice.h: the lamp that a light path or a VPL on a lamp starts from is chosen by what it
// brings to the view. Lamps behind walls would else take most of a set.
//
//   p_l = P_l/5 + 4/5 W_l/W
//
//   P_l  probability of lamp l by power (emitters.h)
//   W_l  worth (worth.h) of all VPLs that a pilot has from l, on it and where its light bounced to;
//        W: of all lamps
//
// Inside a lamp its emitters keep their proportion. What is chosen is divided by p_l, which is
// above 0 where P_l is. So a poor pilot costs noise, never bias; no VPL is more than five times as
// bright as by power. The bound on a lamp goes by the same p (Transport::lightBound), here and
// where the set is asked. Lamps of caustic photons are chosen by power.
//
// A pilot that says little is not followed: where sum (W_l/W)^2/P_l < 2, power is as good. The sum
// is 1 where each lamp brings its share of power.
//
// The pilot is a function of (scene, settings, view): the same for all sets and frames at rest.
// By power, without a pilot: a single lamp, or more of them than a pilot can tell apart. So, too,
// in motion, where each frame would need a pilot, and samples have to stay with their lamps.
//
// Source:  Segovia et al. 2006, whose worth it is; choice of lights by a pilot: Wald et al.,
//          "Interactive Global Illumination in Complex and Highly Occluded Environments", 2003.
// Proved:  tests/gi/lamp_choice_test.cpp.
// Threads: pure function.   Owner: a choice refers to what its transport refers to.   Errors: none.
#pragma once

#include <memory>

#include "common/gi/bidirectional/standard_density.h"
#include "common/gi/eye/task.h"

namespace ninefold {

struct LampChoice {
  std::shared_ptr<const Transport> transport;       // with streams of this choice; null: by power
  std::shared_ptr<const StandardDensity> standard;  // of its light paths
};

// paths: whether light paths are needed.
LampChoice lampChoiceFor(const Transport& transport, const View& view, bool paths);

}  // namespace ninefold
