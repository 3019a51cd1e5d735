#include "common/scene/settings_check.h"

#include "common/base/error.h"
#include "common/scene/methods.h"

namespace ninefold {
namespace {

constexpr int64_t kMostCandidates = 1 << 20, kMostWorths = 1 << 26;
constexpr int kLongestSums = 64;

}  // namespace

void checkTogether(const Settings& s) {
  const MethodFacts& facts = factsOf(s.method);
  if (!facts.has(kReverseVpls)) return;
  const int64_t candidates = int64_t{s.resampling} * (s.directVpls + 2 * int64_t{s.indirectVpls});
  if (candidates > kMostCandidates)
    fail(
        "{} candidates for VPLs in a light set, at most are {}: lower --resampling, --direct-vpls "
        "or --indirect-vpls",
        candidates, kMostCandidates);
  if (candidates * s.cameraPoints > kMostWorths)
    fail(
        "{} candidates for VPLs seen from {} camera points, at most are {} in all: lower "
        "--camera-points or --resampling",
        candidates, s.cameraPoints, kMostWorths);
  if (s.pathLength > kLongestSums)
    fail("path-length is {}: with the method {} it is at most {}, or 0 for no limit", s.pathLength,
         facts.name, kLongestSums);
}

}  // namespace ninefold
