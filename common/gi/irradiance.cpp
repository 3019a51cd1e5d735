#include "common/gi/irradiance.h"

#include "common/gi/caustic_photons.h"
#include "common/gi/vpl_gather.h"

namespace ninefold {

void gatherIrradiance(const Transport& t, const LightSet& lights, const ReceiverSamples& samples,
                      int pathVertices, Scratch& scratch, Receivers& receivers,
                      std::vector<Irradiance>* caustic, RayCounts& rays) {
  receivers.pad();
  gatherVpls(t, lights, samples, pathVertices, scratch.vplGather, receivers, rays.shadow);
  for (const PhotonGrid& grid : lights.photons)
    gatherPhotons(t, grid, pathVertices, receivers, caustic);
  if (t.settings.compensate && pathVertices < kMaxVertices)
    compensate(t, lights, samples, pathVertices, scratch, receivers, rays);
}

}  // namespace ninefold
