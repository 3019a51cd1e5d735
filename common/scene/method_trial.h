// method_trial.h: the state of the method auto, and what it tells: which of two methods a scene and
// a view want.
//
// Unit u of the trial makes one light set by each of both, with randomization u, and looks at the
// same few hundred pixels by both. Page (0, u) records what it saw. Master and clients read the
// same from it.
//
// Proved:  tests/scene/method_trial_test.cpp.
// Threads: pure functions.
// Errors:  fromRecords throws Error for a page that is no such record.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "common/scene/settings.h"
#include "common/state/state_pages.h"

namespace ninefold {

// Those that are tried. The first is taken where the other is not clearly better.
inline constexpr std::array kTried{Method::instantRadiosity, Method::bidirectional};

inline constexpr uint32_t kTrialUnits = 27;
inline constexpr int kTrialPixels = 512;  // about

// What one unit of the trial saw.
struct TrialUnit {
  struct Side {
    float setRays = 0;            // what the light set cost
    float pixelRays = 0;          // what a pixel cost, in the mean
    std::vector<float> radiance;  // luminance of each pixel [W/(m^2 sr)]
  };
  float sets = 1, pixels = 0;             // of a frame
  std::array<Side, kTried.size()> sides;  // alike in pixels
};

PageDelta toRecords(uint32_t unit, const TrialUnit& seen);
TrialUnit fromRecords(const Page& page);

struct Verdict {
  size_t chosen = 0;                          // of kTried
  std::array<double, kTried.size()> error{};  // see above
  std::array<double, kTried.size()> frameRays{};
};

std::string describeTrial(const StatePages& pages);

}  // namespace ninefold
