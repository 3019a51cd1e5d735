// group_shooting.h: traces the photons of one row, and writes down what they leave.
//
// Photon i carries Phi_i/Z from its lamp, by the numbers of i (sampling/halton.h). A hit is kept if
// the last turn before it was D or a glossy lobe, or if it comes straight from a minor lamp. Other
// light has other ways (selective.h).
//
// Lamps that were off when a gesture began have a stream of their own (light/light_streams.h): each
// photon shoots once for each stream.
//
// What has no room in the row is thinned, and what is left carries more.
//
// Paths that an edit does not concern are not traced again (path_replay.h).
//
// A pilot's weight is the flux of its hits, each over T_e of what it fell onto (visual_masking.h).
// Its unit is a photon's mean flux Phi/Z, and it is at most kMostWeight.
//
// Source:  Dmitriev et al. 2002, 4 and 5.   Proved: tests/gi/selective_test.cpp.
// Threads: shoot is a pure function, but for what is kept.   Errors: none.
#pragma once

#include "common/base/counters.h"
#include "common/gi/elements/surface_numbers.h"
#include "common/gi/light/minor_lamps.h"
#include "common/gi/light/transport.h"
#include "common/gi/selective/group_pages.h"
#include "common/gi/selective/kept_paths.h"
#include "common/gi/selective/visual_masking.h"

namespace ninefold {

struct GroupShooting {
  const Transport& transport;
  const PhotonGroups& groups;
  const SurfaceNumbers& surfaces;
  const VisualMasking& masking;
  const MinorLamps& minor;
  uint64_t stamp = 0;                      // of the transport's scene
  float lampFlux = 0;                      // of all lamps as they are now, largest component [W]
  size_t room = 0;                         // hits that a row has room for
  std::shared_ptr<const PathWorld> world;  // of the transport's scene
  KeptPaths* kept = nullptr;               // null: there are too many

  // version: that it is made for.
  PhotonRow shoot(uint32_t row, uint32_t randomization, uint32_t version, RayCounts& rays) const;

 private:
  Pilot pilotOf(const std::vector<ElementHit>& hits, size_t first, double meanFlux) const;
};

}  // namespace ninefold
