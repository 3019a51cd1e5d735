#include "common/gi/irradiance.h"

#include "common/gi/caustic_photons.h"
#include "common/gi/vpl_gather.h"

namespace ninefold {

void gatherIrradiance(const Transport& t, const LightSet& lights, const ReceiverSamples& samples,
                      int pathVertices, Scratch& scratch, Receivers& receivers,
                      std::vector<Irradiance>* caustic, RayCounts& rays) {
  receivers.pad();
  gatherVpls(t, lights.vpls, pathVertices, receivers, rays.shadow);
  if (!lights.photons.empty() || !lights.indirectPhotons.empty()) {
    for (size_t i = 0; i < receivers.size(); ++i) {
      const Vec3 x = receivers.position(i), n = receivers.ng(i);
      const Irradiance e = gatherPhotons(t, lights.photons, x, n, pathVertices) +
                           gatherPhotons(t, lights.indirectPhotons, x, n, pathVertices);
      receivers.addIrradiance(i, e);
      if (caustic != nullptr) (*caustic)[i] = e;
    }
  }
  if (t.settings.compensate && pathVertices < kMaxVertices)
    compensate(t, lights, samples, pathVertices, scratch, receivers, rays);
}

}  // namespace ninefold
