// minor_lamps.h: faint lamps, whose direct light photons bring, not virtual lights.
//
//   the faintest lamps that have together at most the share F of all power
//
// The virtual lights are left to the lamps whose shadows matter. Shadows of the others have edges
// as soft as mesh elements are wide, and what light they bring into narrow places is blurred.
//
// In a gesture the lamps are those that it began with, so that nothing that is done to one lamp
// changes how the light of another is found. Lamps that were off then are not among them.
//
// Source:  Dmitriev et al. 2002, 6.1 (lamps whose shadows matter, and the others).
// Proved:  tests/gi/minor_lamps_test.cpp.
// Threads: const after construction.   Errors: none.
#pragma once

#include <vector>

#include "common/scene/emitters.h"

namespace ninefold {

class MinorLamps {
 public:
  MinorLamps() = default;  // there are none
  // share: F in [0, 1]. begun: of the scene that a gesture began with, or null.
  MinorLamps(const Emitters& emitters, float share, const MinorLamps* begun);

  bool has(uint32_t lamp) const;  // lampOf an emitter
  const std::vector<uint32_t>& lamps() const { return lamps_; }

 private:
  std::vector<uint32_t> lamps_;  // ascending
};

}  // namespace ninefold
