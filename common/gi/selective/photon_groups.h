// photon_groups.h: which photons of the pool are a group.
//
//   Z = N_g N_p R                       photons of the pool
//   pilots of group g                   i = g N_p + k,           0 <= k < N_p
//   corrective photons of group g       i = N_g N_p + g + c N_g, 0 <= c < N_p (R - 1)
//   the group that photon i is like     i mod N_g
//
// N_g is a product of powers of 2, 3, 5 and 7, so that its corrective photons have almost equal
// numbers (sampling/halton.h). Its pilots are spread over all paths that there are: those of one
// group tell what became of the others.
//
// Source:  Dmitriev et al. 2002, 5.1.   Proved: tests/gi/photon_groups_test.cpp.
// Threads: plain value.   Errors: none; settings are checked before (scene/settings_check.h).
#pragma once

#include <cstdint>

#include "common/scene/settings.h"

namespace ninefold {

class PhotonGroups {
 public:
  explicit PhotonGroups(const Settings& s)
      : groups_(static_cast<uint32_t>(s.photonGroups)),
        pilots_(static_cast<uint32_t>(s.photonPool / s.photonGroups / s.pilotRatio)),
        photons_(static_cast<uint32_t>(s.photonPool)) {}

  uint32_t groups() const { return groups_; }        // N_g
  uint32_t pilotsOfEach() const { return pilots_; }  // N_p
  uint32_t photons() const { return photons_; }      // Z
  uint32_t photonsOfEach() const { return photons_ / groups_; }
  uint32_t likeGroup(uint32_t photon) const { return photon % groups_; }

  // Photon k of group g; pilots first.
  uint32_t photon(uint32_t g, uint32_t k) const {
    return k < pilots_ ? g * pilots_ + k : groups_ * pilots_ + g + (k - pilots_) * groups_;
  }

 private:
  uint32_t groups_, pilots_, photons_;
};

}  // namespace ninefold
