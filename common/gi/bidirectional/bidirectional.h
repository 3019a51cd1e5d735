// bidirectional.h: instant radiosity whose VPLs come from both ends: from the lamps, and from what
// the camera sees. So it finds light that comes round corners. A set has r times as many candidates
// as VPLs; it keeps those that bring much to the picture. For each set:
//
//   1  standard candidates: as in instant radiosity, r times as many      direct_vpls.h,
//                                                                         indirect_vpls.h
//   2  M camera points, and places that they see: reverse candidates      camera_points.h,
//                                                                         reverse_places.h
//   3  each path belongs to one family or is shared between both          partition.h
//   4  worth of each candidate, from guesses of its power                 worth.h
//   5  few are kept, evenly in space                                      resampling.h,
//                                                                         tournament.h
//   6  their power is made exact                                          raw_light.h
//
// At rest pilots of the view decide before that which lamps to start from (lamp_choice.h), and
// whether a fifth of the candidates will do (effort.h). They take about as long as the sets of one
// frame, once a view. Very many candidates come in batches (batches.h).
//
// The set is good for any point, but best for those that its view sees. With all candidates it
// takes three to nine times as long as one of instant radiosity, so that small pictures gain less.
//
// Source:  Segovia, Iehl, Mitanchey and Péroche, "Bidirectional Instant Radiosity", 2006.
// Proved:  tests/gi/bidirectional_test.cpp; furnace, form factors, agreement with the path tracer.
// Fails:   a VPL where few camera points look may be bright, and shows as a spot near by. Light is
//          found as rarely as light paths come within two bounces of what the view sees. Without
//          compensation VPLs lack what the bound cuts off, reverse ones twice.
// Threads, owner, errors: as method.h says.
#pragma once

#include "common/gi/bidirectional/effort.h"
#include "common/gi/light_set/light_set_method.h"

namespace ninefold {

class Bidirectional final : public LightSetMethod {
 public:
  // `begun`: of the scene that a gesture began with, null at rest. The number of light paths and
  // the partition stay as they are there.
  Bidirectional(const Transport& transport, const Bidirectional* begun);

  std::shared_ptr<const FrameLight> light(const FrameKey& frame, int set,
                                          std::span<const View> views,
                                          const MethodState* state) const override;

 private:
  ViewChoice choiceFor(const FrameKey& frame, std::span<const View> views) const;

  const bool isGesture_;
  const int pathsLog2_;  // of the candidates, see indirect_vpls.h
  const std::shared_ptr<const StandardDensity> standardDensity_;  // by power
  const ViewChoices choices_;
};

}  // namespace ninefold
