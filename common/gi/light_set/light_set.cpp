#include "common/gi/light_set/light_set.h"

#include <fmt/format.h>

#include "common/gi/light/light_path.h"
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

void addStandardVpls(const Transport& t, const FrameKey& frame, int k, int times, int pathsLog2,
                     LightSet& set) {
  addDirectVpls(t, frame, k, times, set.vpls);
  if (pathsLog2 < 0) return;
  addIndirectVpls(t, frame, k, pathsLog2, set, set.rays);
  std::erase_if(set.vpls, [](const Vpl& vpl) { return isBlack(vpl.power) && vpl.glossy < 0; });
}

void gatherBounded(const Transport& t, const LightSet& lights, const ReceiverSamples& samples,
                   int pathVertices, LightSetScratch& scratch, Receivers& receivers,
                   std::vector<Irradiance>* caustic, RayCounts& rays) {
  receivers.pad();
  gatherVpls(t, lights, samples, pathVertices, t.settings.vplRoulette, scratch.vplGather, receivers,
             rays.shadow);
  for (const PhotonGrid& grid : lights.photons)
    gatherPhotons(t, grid, pathVertices, receivers, caustic);
}

void gatherLightSet(const Transport& t, const LightSet& lights, const ReceiverSamples& samples,
                    int pathVertices, LightSetScratch& scratch, Receivers& receivers,
                    std::vector<Irradiance>* caustic, RayCounts& rays) {
  gatherBounded(t, lights, samples, pathVertices, scratch, receivers, caustic, rays);
  if (t.settings.compensate && pathVertices < kMaxVertices)
    compensate(t, samples, pathVertices, {}, scratch.compensation, receivers, rays,
               [&](int vertices, Receivers& points) {
                 gatherLightSet(t, lights, samples, vertices, scratch, points, nullptr, rays);
               });
}

}  // namespace ninefold
