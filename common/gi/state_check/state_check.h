// state_check.h: a method for tests of states alone. Its light tells, bit for bit, which state lit
// it:
//
//   E = pi (0.5 + h 2^-33)     h: upper half of the state's hash     the same everywhere [W/m^2]
//
// Unit n of a step changes the state by amounts that are hashes of the settings' seed, the step's
// randomization, n, and the state that the step began from:
//
//   page (0, n mod 6)    records: 8 bytes
//   page (1, 0)          three sums, of which one is taken from
//   page (1, 1)          one sum, the page's last
//
// So a picture is right only if each of its steps was, from the first one on. With seed 0 a sum
// overflows in the second step.
// Threads, owner, errors: as method.h says.
#pragma once

#include "common/gi/method/layered_method.h"

namespace ninefold {

class StateCheck final : public LayeredMethod {
 public:
  using LayeredMethod::LayeredMethod;

  std::shared_ptr<const FrameLight> light(const FrameKey& frame, int set,
                                          std::span<const View> views,
                                          const MethodState* state) const override;
  std::unique_ptr<Scratch> makeScratch() const override;
  StepResult step(const StatePages& pages, const StepKey& step, uint32_t unit,
                  const View& view) const override;
  std::shared_ptr<const MethodState> digest(const StatePages& pages,
                                            const MethodState* before) const override;

 protected:
  void query(const FrameLight& light, const ReceiverSamples& samples, int pathVertices,
             LayeredScratch& scratch, Receivers& receivers, std::vector<Irradiance>* caustic,
             RayCounts& rays) const override;
};

}  // namespace ninefold
