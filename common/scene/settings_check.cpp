#include "common/scene/settings_check.h"

#include "common/base/error.h"
#include "common/scene/methods.h"

namespace ninefold {
namespace {

constexpr int64_t kMostCandidates = 1 << 20, kMostDensityRays = 1 << 26;
constexpr int kLongestSums = 64;

}  // namespace

void checkTogether(const Settings& s) {
  const MethodFacts& facts = factsOf(s.method);
  if (!facts.has(kReverseVpls)) return;
  const int64_t vpls = s.directVpls + 2 * int64_t{s.indirectVpls};
  const int64_t candidates = s.resampling * vpls;
  if (candidates > kMostCandidates)
    fail(
        "{} candidates for VPLs in a light set, at most are {}: lower --resampling, --direct-vpls "
        "or --indirect-vpls",
        candidates, kMostCandidates);
  if (vpls * s.cameraPoints > kMostDensityRays)
    fail(
        "{} VPLs in a light set, each seen from {} camera points, at most are {} in all: lower "
        "--camera-points, --direct-vpls or --indirect-vpls",
        vpls, s.cameraPoints, kMostDensityRays);
  if (s.pathLength > kLongestSums)
    fail("path-length is {}: with the method {} it is at most {}, or 0 for no limit", s.pathLength,
         facts.name, kLongestSums);
}

}  // namespace ninefold
