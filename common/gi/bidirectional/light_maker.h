// light_maker.h: makes one light set of the bidirectional method, or one batch of it; the steps of
// bidirectional.h.
//
// Threads: one set's working memory.   Owner: refers to its arguments.   Errors: none.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "common/gi/bidirectional/batches.h"
#include "common/gi/bidirectional/effort.h"
#include "common/gi/bidirectional/estimated_density.h"
#include "common/gi/bidirectional/partition.h"
#include "common/gi/bidirectional/raw_light.h"
#include "common/gi/bidirectional/resampling.h"
#include "common/gi/bidirectional/reverse_places.h"
#include "common/gi/bidirectional/worth.h"

namespace ninefold {

class LightMaker {
 public:
  // method: its transport, by which photons choose lamps.
  LightMaker(const Transport& method, const ViewChoice& choice, const Batch& batch,
             const FrameKey& frame, int set, std::span<const View> views);

  // What the candidates are worth.
  WorthSummary summary() { return summaryOf(worths().values(), candidates_.vpls.size()); }
  // Adds VPLs to a set; the first batch adds the photons.
  void make(LightSet& out);

 private:
  // q where a ray ended, and a guess of it. reached: as in reverse_density.h.
  float density(const ReversePlace& y);
  float guessDensity(const ReversePlace& y, uint32_t reached);
  // Step 4: what the candidates are worth, the standard ones first, then the reverse places.
  Worth worths();
  std::vector<Vec3> positions() const;  // of the candidates, in the same order
  // Step 6.
  void keepStandard(const Vpl& candidate, float gain, float seen, LightSet& out);
  void keepReverse(const std::vector<Kept>& kept, const Worth& worth, LightSet& out);

  const Transport& method_;
  const Transport& t_;  // of the choice
  const Batch batch_;
  const FrameKey frame_;  // of the batch
  const int k_;
  const int shot_;  // N_r
  const ReceiverSamples samples_, guesses_;
  RayCounts rays_;
  LightSetScratch scratch_;
  const LightSet candidates_;  // standard ones
  const RawLight raw_;
  const CameraPoints camera_;
  const Partition partition_;
  const std::optional<EstimatedDensity> estimated_;  // for the rule `equal`
  const std::vector<ReversePlace> places_;
};

}  // namespace ninefold
