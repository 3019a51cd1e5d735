// radiosity.h: instant radiosity. E at all receivers of a layer: VPLs, caustic photons and
// compensation, each counted once.
//
// Source:  Keller 1997; Wald et al. 2002; compensation: Kollig and Keller 2004.
// Threads, owner, errors: as method.h says.
#pragma once

#include "common/gi/method/layered_method.h"
#include "common/gi/radiosity/light_set.h"
#include "common/gi/vpl/compensation.h"
#include "common/gi/vpl/vpl_gather.h"

namespace ninefold {

struct RadiosityScratch final : LayeredScratch {
  VplGatherScratch vplGather;
  CompensationScratch compensation;
};

class Radiosity final : public LayeredMethod {
 public:
  // `begun`: of the scene that a gesture began with, null at rest; m stays as it is there.
  Radiosity(const Transport& transport, const Radiosity* begun);

  std::shared_ptr<const FrameLight> light(const FrameKey& frame, int set,
                                          const View& view) const override;
  std::unique_ptr<Scratch> makeScratch() const override;

 protected:
  void query(const FrameLight& light, const ReceiverSamples& samples, int pathVertices,
             LayeredScratch& scratch, Receivers& receivers, std::vector<Irradiance>* caustic,
             RayCounts& rays) const override;

 private:
  const int pathsLog2_;  // m of indirect_vpls.h
};

}  // namespace ninefold
