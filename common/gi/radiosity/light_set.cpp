#include "common/gi/radiosity/light_set.h"

#include <fmt/format.h>

#include "common/gi/vpl/direct_vpls.h"
#include "common/gi/vpl/indirect_vpls.h"

namespace ninefold {

std::string LightSet::oddValue() const {
  for (size_t i = 0; i < vpls.size(); ++i)
    if (const Vec3 power = vpls[i].power; !isFinite(power))
      return fmt::format("VPL {} has a power of ({}, {}, {})", i, power.x, power.y, power.z);
  for (const PhotonGrid& grid : photons)
    for (const Photon& photon : grid.photons())
      if (!isFinite(photon.flux))
        return fmt::format("a photon has a flux of ({}, {}, {})", photon.flux.x, photon.flux.y,
                           photon.flux.z);
  return {};
}

LightSet makeLightSet(const Transport& t, const FrameKey& frame, int k, int pathsLog2) {
  LightSet set;
  if (t.emitters.empty()) return set;
  addDirectVpls(t, frame, k, set.vpls);
  if (pathsLog2 >= 0) {
    addIndirectVpls(t, frame, k, pathsLog2, set, set.rays);
    std::erase_if(set.vpls, [](const Vpl& vpl) { return isBlack(vpl.power) && vpl.glossy < 0; });
  }
  set.photons = causticPhotons(t, frame, k, set.vpls, set.rays);
  return set;
}

}  // namespace ninefold
