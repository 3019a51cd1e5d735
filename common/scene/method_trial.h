// method_trial.h: the state of the method auto, and what it tells: which of two methods finds the
// light of a scene and view sooner.
//
// Each of U units makes one light set by each method, with random numbers of its own, and looks at
// the same pixels p by both. Page (0, u) records what unit u saw. Master and clients read the same
// from it. With L_up what unit u sees of pixel p by method m, luminance:
//
//   e_m = mean over p of Var_u L_up / (L_p^2 + 0.01 L^2)       squared relative error of one set
//   c_m = 2 K s_m + P (r_m + 5)                                cost of a frame, in rays of pixels
//   d_m   share of the pixels that m leaves dark: its mean is below a hundredth of the other's
//
//   L_p, L   means of both methods, of pixel p and of all pixels           [W/(m^2 sr)]
//   s_m, r_m rays of a light set, and of a pixel; a set's take twice as long as a pixel's
//   K, P     light sets and pixels of a frame; 5: what a pixel costs besides its rays
//
// The choice is the second method
//
//   if d_1 > d_2 + 1/32        light that the first finds in none of U sets, the second in many:
//                              e_1 says nothing of it then, for what is never seen does not vary
//   or e_1 c_1 > 1.5 e_2 c_2   errors after equal time; the first is simpler and wins when in doubt
//
// and the first if not, or if d_2 > d_1 + 1/32. e_m is without the twentieth of the pixels where it
// is largest: single spots do not decide.
//
// Proved:  tests/scene/method_trial_test.cpp, tests/gi/automatic_test.cpp.
// Fails:   a view where both find the light as rarely: U sets tell too little of either.
// Threads: pure functions.
// Errors:  Error for pages that are no record of a trial.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "common/scene/settings.h"
#include "common/state/state_pages.h"

namespace ninefold {

inline constexpr std::array kTried{Method::instantRadiosity, Method::bidirectional};
inline constexpr uint32_t kTrialUnits = 27;
inline constexpr int kTrialPixels = 512;  // or fewer

// What one unit of the trial saw.
struct TrialUnit {
  struct Side {
    float setRays = 0;            // s
    float pixelRays = 0;          // r, in the mean
    std::vector<float> radiance;  // luminance of each pixel [W/(m^2 sr)]
  };
  float sets = 1, pixels = 0;             // of a frame
  std::array<Side, kTried.size()> sides;  // the same pixels
};

PageDelta toRecord(uint32_t unit, const TrialUnit& seen);

struct Verdict {
  struct Side {
    double error = 0, cost = 0, dark = 0;  // e, c, d
  };
  std::array<Side, kTried.size()> sides;
  size_t chosen = 0;  // of kTried
};

// One unit or more; none: the first method.
Verdict judge(const std::vector<TrialUnit>& units);
Verdict verdictOf(const StatePages& pages);
// A line for people.
std::string describeTrial(const StatePages& pages);

}  // namespace ninefold
