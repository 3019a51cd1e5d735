// photon_radii.h: no photon is a bright spot of its own. Where many photons come down, each carries
// little and a caustic is as sharp as the frame's radius; where few come down, each is spread wider:
//
//   r_j = 2^j r,   the least j < kPhotonKinds with   Phi/(pi r_j^2) <= E_max
//   E_max = kBrightest E_0 (r_first/r)^2,   E_0 = flux of all lights / (4 pi R^2)
//
// R: radius of the scene's bounds, E_0 and it as a gesture found them (transport.h); r: the frame's radius, r_first: the first frame's. All r_j shrink
// with r, so the estimate stays consistent.
//
// Source:  written for this project; the same end as photon differentials (Schjoth et al. 2007).
// Fails:   light that is spread wide leaks to neighbours on the same side, which goes with r.
// Threads: const.   Errors: none.
#pragma once

#include <array>

#include "common/gi/light/transport.h"
#include "common/gi/photons/photon_grid.h"

namespace ninefold {

inline constexpr size_t kPhotonKinds = 5;

using SortedPhotons = std::array<std::vector<Photon>, kPhotonKinds>;
using CausticPhotons = std::array<PhotonGrid, kPhotonKinds>;  // one grid a radius

class PhotonRadii {
 public:
  PhotonRadii(const Transport& transport, Metres radius);

  // j for a photon of this flux [W].
  size_t choose(Flux flux) const {
    const float brightest = maxComponent(flux);
    size_t j = 0;
    while (j + 1 < kPhotonKinds && brightest > most_[j]) ++j;
    return j;
  }
  Metres radius(size_t j) const { return static_cast<float>(1u << j) * radius_; }

 private:
  Metres radius_;
  std::array<float, kPhotonKinds> most_;  // flux that r_j can bear [W]
};

}  // namespace ninefold
