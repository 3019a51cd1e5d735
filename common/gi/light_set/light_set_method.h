// light_set_method.h: a method whose light is a LightSet. What is left to it is to make one.
//
// Threads, owner, errors: as method.h says.
#pragma once

#include "common/gi/light_set/light_set.h"

namespace ninefold {

class LightSetMethod : public LayeredMethod {
 public:
  using LayeredMethod::LayeredMethod;

  std::unique_ptr<Scratch> makeScratch() const final;

 protected:
  void query(const FrameLight& light, const ReceiverSamples& samples, int pathVertices,
             LayeredScratch& scratch, Receivers& receivers, std::vector<Irradiance>* caustic,
             RayCounts& rays) const final;
};

}  // namespace ninefold
