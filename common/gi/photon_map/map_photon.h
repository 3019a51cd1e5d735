// map_photon.h: a hit of the pool, and the pages that hold all hits.
//
//   P = total/per-frame      parts of the ring; unit n of the state's steps makes part n mod P anew
//   page = part J + j        j in [0, J): pages of kind 0 that one part may fill
//
// A page is a row of hits, as many as there are. So a path may have any number of hits, and a unit
// writes the pages of its part and no other. What has no room in J pages is thinned (shooting.h).
// As published, each photon has max-level slots, and slot l of photon i stands at i + l total; here
// roulette ends paths, and no light is lost beyond a last slot.
//
// Source:  Jozwowski 2002, 4.1 (ring, oldest first).   Proved: tests/gi/photon_map_test.cpp.
// Threads: plain values.   Errors: pages that are no rows of hits are read as far as they are.
#pragma once

#include <algorithm>
#include <vector>

#include "common/math/units.h"
#include "common/scene/methods.h"
#include "common/state/state_pages.h"

namespace ninefold {

// Adds flux over the area that it is spread to, to E of points around.
struct MapPhoton {
  Vec3 position{0};            // [m]
  Vec3 normal{0};              // geometric, on the side where it landed
  Flux flux{0};                // share of all lamps' flux, over n^2 [W]
  uint32_t diffuseBefore = 0;  // D vertices of its path before it landed

  bool operator==(const MapPhoton&) const = default;
};
static_assert(sizeof(MapPhoton) == 40);

class MapLayout {
 public:
  static constexpr size_t kPerPage = kPageBytes / sizeof(MapPhoton);
  static constexpr size_t kMostPerPath = 64;  // mean number of hits that there is room for ...
  static constexpr size_t kMostPages = 30;    // ... in pages that can be sent at once, 2 MiB

  explicit MapLayout(const Settings& s)
      : parts_(factsOf(Method::photonMap).state->unitsOfAll(s)),
        pages_(std::min(
            kMostPages,
            (static_cast<size_t>(s.mapPerFrame) * kMostPerPath + kPerPage - 1) / kPerPage)) {}

  uint32_t parts() const { return parts_; }
  uint32_t partOf(uint32_t unit) const { return unit % parts_; }
  size_t room() const { return pages_ * kPerPage; }  // hits of a part

  // What makes the pages of a part hold these hits, of which there is room for all.
  PageDeltas replace(const StatePages& pages, uint32_t part,
                     const std::vector<MapPhoton>& photons) const;

 private:
  uint32_t parts_;
  size_t pages_;  // J
};

// All hits, in the order of their pages.
std::vector<MapPhoton> readPhotons(const StatePages& pages);

}  // namespace ninefold
