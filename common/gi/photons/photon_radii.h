// photon_radii.h: how wide a photon is spread: as wide as its flux asks for, as narrow as the
// pattern of the light asks for.
//
//   r_j = 2^(j-2) r,   0 <= j < kPhotonKinds
//
// No photon is a bright spot of its own. Where many photons come down, each carries little; where
// few come down, each is spread wider:
//
//   j >= 2, the least with   Phi/(pi r_j^2) <= E_max
//   E_max = kBrightest E_0 (r_first/r)^2,   E_0 = flux of all lights / (4 pi R^2)
//
// Then j falls by up to 2 where the lamp's photons do not lie evenly within r_j (photon_spread.h).
//
//   r, r_first   radius of this frame and of the first frame                                   [m]
//   R            radius of the scene's bounds. E_0 is as a gesture found it (transport.h)      [m]
//
// j depends on the first radii alone, so all r_j shrink with r: the estimate stays consistent, and
// blur goes with r^2 (image/radius_bias.h).
//
// Source:  written for this project; the same end as photon differentials (Schjoth et al. 2007).
// Fails:   light that is spread wide leaks to neighbours on the same side, which goes with r.
// Threads: const.   Errors: none.
#pragma once

#include <array>

#include "common/gi/light/transport.h"
#include "common/gi/photons/photon_grid.h"

namespace ninefold {

inline constexpr size_t kPhotonHalvings = 2;  // r_0 = r/4
inline constexpr size_t kPhotonKinds = kPhotonHalvings + 5;

using SortedPhotons = std::array<std::vector<Photon>, kPhotonKinds>;
using CausticPhotons = std::array<PhotonGrid, kPhotonKinds>;  // one grid a radius

class PhotonRadii {
 public:
  PhotonRadii(const Transport& transport, Metres radius);

  // j >= kPhotonHalvings for a photon of this flux [W].
  size_t choose(Flux flux) const {
    const float brightest = maxComponent(flux);
    size_t j = kPhotonHalvings;
    while (j + 1 < kPhotonKinds && brightest > most_[j]) ++j;
    return j;
  }
  Metres radius(size_t j) const { return kFactors[j] * radius_; }
  // ... in the first frame.
  Metres first(size_t j) const { return kFactors[j] * first_; }

 private:
  static constexpr std::array<float, kPhotonKinds> kFactors{0.25f, 0.5f, 1, 2, 4, 8, 16};
  Metres radius_, first_;
  std::array<float, kPhotonKinds> most_;  // flux that r_j can bear [W]
};

}  // namespace ninefold
