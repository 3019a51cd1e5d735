#include "common/gi/radiosity/radiosity.h"

#include "common/gi/light/light_path.h"
#include "common/gi/vpl/indirect_vpls.h"

namespace ninefold {
namespace {

void gather(const Transport& t, const LightSet& lights, const ReceiverSamples& samples,
            int pathVertices, RadiosityScratch& scratch, Receivers& receivers,
            std::vector<Irradiance>* caustic, RayCounts& rays) {
  receivers.pad();
  gatherVpls(t, lights, samples, pathVertices, scratch.vplGather, receivers, rays.shadow);
  for (const PhotonGrid& grid : lights.photons)
    gatherPhotons(t, grid, pathVertices, receivers, caustic);
  if (t.settings.compensate && pathVertices < kMaxVertices)
    compensate(t, samples, pathVertices, scratch.compensation, receivers, rays,
               [&](int vertices, Receivers& points) {
                 gather(t, lights, samples, vertices, scratch, points, nullptr, rays);
               });
}

}  // namespace

Radiosity::Radiosity(const Transport& t, const Radiosity* begun)
    : LayeredMethod(t),
      pathsLog2_(begun != nullptr && begun->pathsLog2_ >= 0 ? begun->pathsLog2_
                                                            : lightPathsLog2(t)) {}

std::shared_ptr<const FrameLight> Radiosity::light(const FrameKey& frame, int set,
                                                   const View&) const {
  return std::make_shared<const LightSet>(makeLightSet(t_, frame, set, pathsLog2_));
}

std::unique_ptr<Scratch> Radiosity::makeScratch() const {
  return std::make_unique<RadiosityScratch>();
}

void Radiosity::query(const FrameLight& light, const ReceiverSamples& samples, int pathVertices,
                      LayeredScratch& scratch, Receivers& receivers,
                      std::vector<Irradiance>* caustic, RayCounts& rays) const {
  gather(t_, static_cast<const LightSet&>(light), samples, pathVertices,
         static_cast<RadiosityScratch&>(scratch), receivers, caustic, rays);
}

}  // namespace ninefold
