// light_maker.h: makes one light set of the bidirectional method; the steps of bidirectional.h.
//
// Threads: one set's working memory.   Owner: refers to its arguments.   Errors: none.
#pragma once

#include <span>
#include <vector>

#include "common/gi/bidirectional/partition.h"
#include "common/gi/bidirectional/raw_light.h"
#include "common/gi/bidirectional/resampling.h"
#include "common/gi/bidirectional/reverse_places.h"
#include "common/gi/bidirectional/worth.h"

namespace ninefold {

class LightMaker {
 public:
  LightMaker(const Transport& transport, const StandardDensity& standardDensity, int pathsLog2,
             const FrameKey& frame, int set, std::span<const View> views);

  // Adds VPLs and photons to an empty set.
  void make(LightSet& out);

 private:
  // Step 4: what the candidates are worth, the raw VPLs first, then the reverse places.
  Worth worths();
  std::vector<Vec3> positions() const;  // of the candidates, in the same order
  // Step 6.
  void keepStandard(const Vpl& candidate, float gain, float seen, LightSet& out);
  void keepReverse(const std::vector<Kept>& kept, const Worth& worth, LightSet& out);

  const Transport& t_;
  const FrameKey& frame_;
  const int k_;
  const int shot_;  // N_r
  const ReceiverSamples samples_, guesses_;
  RayCounts rays_;
  LightSetScratch scratch_;
  const RawLight raw_;
  CameraPoints camera_;
  const Partition partition_;
  const std::vector<ReversePlace> places_;
};

}  // namespace ninefold
