// photon_groups.h: which photons of the pool are traced together.
//
//   Z = N_g N_p R                   photons of the pool
//   pilots                          i in [0, N_g N_p), in parts of R N_p
//   corrective photons of group g   i = N_g N_p + g + c N_g, 0 <= c < N_p (R - 1)
//   group that photon i is like     i mod N_g
//
// N_g is a product of powers of 2, 3, 5 and 7, so that its corrective photons have almost equal
// numbers (sampling/halton.h). Pilots are spread over all paths that there are, N_p of them like
// each group: they tell what became of it.
//
// A row is what one unit of a step traces: a group's corrective photons, or a part of the pilots,
// about as many. (As published, pilots belong to groups and are traced together with them. All
// pilots at first tell more: selective.h.)
//
// Source:  Dmitriev et al. 2002, 5.1.   Proved: tests/gi/group_pages_test.cpp.
// Threads: plain value.   Errors: none; settings are checked before (scene/settings_check.h).
#pragma once

#include <algorithm>
#include <cstdint>

#include "common/scene/settings.h"

namespace ninefold {

class PhotonGroups {
 public:
  explicit PhotonGroups(const Settings& s)
      : groups_(static_cast<uint32_t>(s.photonGroups)),
        photons_(static_cast<uint32_t>(s.photonPool)),
        ratio_(static_cast<uint32_t>(s.pilotRatio)),
        pilots_(photons_ / ratio_) {}

  bool operator==(const PhotonGroups&) const = default;

  uint32_t photons() const { return photons_; }  // Z
  uint32_t groups() const { return groups_; }    // N_g
  uint32_t likeGroup(uint32_t photon) const { return photon % groups_; }

  // Rows: the groups, then the parts of the pilots.
  uint32_t rows() const { return groups_ + (groups_ + ratio_ - 1) / ratio_; }
  bool hasPilots(uint32_t row) const { return row >= groups_; }
  uint32_t photonsOf(uint32_t row) const {
    if (!hasPilots(row)) return (photons_ - pilots_) / groups_;
    return std::min(pilotsOfPart(), pilots_ - (row - groups_) * pilotsOfPart());
  }
  // Photon k of a row.
  uint32_t photon(uint32_t row, uint32_t k) const {
    return hasPilots(row) ? (row - groups_) * pilotsOfPart() + k : pilots_ + row + k * groups_;
  }

 private:
  uint32_t pilotsOfPart() const { return pilots_ / groups_ * ratio_; }

  uint32_t groups_, photons_, ratio_;
  uint32_t pilots_;  // of all groups
};

}  // namespace ninefold
