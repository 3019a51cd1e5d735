// effort.h: how many candidates the sets of a view have. Where light paths find the light as well
// as the camera does, and candidates are worth about alike, few of them do as well as many.
//
//   r' = r/5,  M' = M/2     if R < 0.4 and S < 12, in the mean of nine sets of a pilot
//
//   R   share of the reverse places in the worth of all candidates; 1 if nothing is worth anything
//   S   N sum v^2 / (sum v)^2, v: worth of each of N candidates; 1 if all are worth the same
//
// r and M decide how much noise is left, never what the mean is. So a wrong pilot costs noise or
// time. Measured (docs/performance.md): R is 0.14 to 0.36 and S 1.3 to 10 in rooms that light comes
// into straight, 0.48 to 0.82 and 16 to 140 where it comes round corners.
//
// The pilot is a function of (scene, settings, view): the same for all sets and frames at rest. In
// motion there is none. Nor is there one with --partition equal, which is as published, or r < 5.
//
// Proved:  tests/gi/effort_test.cpp.
// Threads: ViewChoices may be asked by many at once; one makes, the others wait. The rest is pure.
// Owner:   a choice refers to what its transport refers to.   Errors: none.
#pragma once

#include <mutex>
#include <optional>
#include <span>

#include "common/gi/bidirectional/lamp_choice.h"

namespace ninefold {

// Of the candidates of one set.
struct WorthSummary {
  double reverse = 1;  // R
  double uneven = 1;   // S
};

// `values`: the standard candidates first; firstReverse: how many these are.
WorthSummary summaryOf(std::span<const float> values, size_t firstReverse);
bool fewWillDo(std::span<const WorthSummary> sets);

// How the light of a view is made.
struct ViewChoice {
  std::shared_ptr<const Transport> transport;       // null: the method's own
  std::shared_ptr<const StandardDensity> standard;  // of its light paths
  int pathsLog2 = -1;                               // of its candidates, see indirect_vpls.h
};

// byMethod: without any pilot.
ViewChoice viewChoiceFor(const Transport& transport, const ViewChoice& byMethod, const View& view);

// That of the last view.
class ViewChoices {
 public:
  ViewChoice of(const Transport& transport, const ViewChoice& byMethod, const View& view) const;

 private:
  mutable std::mutex mutex_;
  mutable std::optional<View> view_;
  mutable ViewChoice choice_;
};

}  // namespace ninefold
