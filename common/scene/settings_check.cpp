#include "common/scene/settings_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "common/base/error.h"
#include "common/scene/methods.h"

namespace ninefold {
namespace {

constexpr int64_t kMostCandidates = 1 << 20, kMostDensityRays = 1 << 26;
constexpr int kLongestSums = 64;
constexpr int kMostParts = 65536;
constexpr uint64_t kMostMapTriangles = 1 << 23;

// The largest divisor of n that is not above `wanted`.
int nearestDivisor(int n, int wanted) {
  while (n % wanted != 0) --wanted;
  return wanted;
}

void checkReverse(const Settings& s, const MethodFacts& facts) {
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

void checkMap(const Settings& s) {
  if (s.mapPerFrame > s.mapPhotons)
    fail(
        "map-photons-per-frame is {}, more than all {} of the pool: lower it, or raise "
        "--map-photons",
        s.mapPerFrame, s.mapPhotons);
  if (s.mapPhotons % s.mapPerFrame != 0)
    fail("map-photons-per-frame is {} and does not divide the {} of the pool: {} would do",
         s.mapPerFrame, s.mapPhotons, nearestDivisor(s.mapPhotons, s.mapPerFrame));
  if (s.mapPhotons / s.mapPerFrame > kMostParts)
    fail("the pool has {} parts of {} photons, at most are {}: raise --map-photons-per-frame",
         s.mapPhotons / s.mapPerFrame, s.mapPerFrame, kMostParts);
}

// The multiple of `unit` nearest to n, at least one.
int nearestMultiple(int n, int unit) { return std::max((n + unit / 2) / unit, 1) * unit; }

void checkGroups(const Settings& s) {
  int left = s.photonGroups;
  for (const int prime : {2, 3, 5, 7})
    while (left % prime == 0) left /= prime;
  if (left != 1)
    fail("photon-groups is {}: it must be a product of 2, 3, 5 and 7, as 288 or 10080 is",
         s.photonGroups);
  constexpr int kMostOfGroup = 16384;  // so that what they hit can be sent at once
  if (s.photonPool / s.photonGroups > kMostOfGroup)
    fail("a group has {} of the photons, at most are {}: raise --photon-groups",
         s.photonPool / s.photonGroups, kMostOfGroup);
  const int64_t unit = int64_t{s.photonGroups} * s.pilotRatio;
  if (s.photonPool % unit == 0) return;
  if (unit > 4194304)
    fail("photon-groups {} times pilot-ratio {} is more than a pool can have: lower one",
         s.photonGroups, s.pilotRatio);
  fail("photon-pool is {}, no multiple of photon-groups {} times pilot-ratio {}: {} would do",
       s.photonPool, s.photonGroups, s.pilotRatio,
       nearestMultiple(s.photonPool, static_cast<int>(unit)));
}

// Lines of different slopes would meet in the same points, again and again.
void checkLines(const Settings& s) {
  const int divisor = std::gcd(s.fieldDirections, s.fieldDistances);
  if (divisor == 1) return;
  // None fewer than two: else the next ones above.
  int distances = s.fieldDistances;
  while (std::gcd(s.fieldDirections, distances) != 1) --distances;
  if (distances < 2) distances = s.fieldDistances + 1;
  while (std::gcd(s.fieldDirections, distances) != 1) ++distances;
  fail(
      "field-directions {} and field-distances {} have the divisor {} in common, which focuses the "
      "lines in some places: {} distances would do",
      s.fieldDirections, s.fieldDistances, divisor, distances);
}

}  // namespace

void checkTogether(const Settings& s) {
  const MethodFacts& facts = factsOf(s.method);
  if (facts.has(kReverseVpls)) checkReverse(s, facts);
  if (facts.has(kMapPhotons)) checkMap(s);
  if (facts.has(kElementPhotons)) checkGroups(s);
  if (facts.has(kFieldPhotons)) checkLines(s);
}

void checkWith(const Scene& scene, const Settings& s) {
  if (s.mapEstimate != MapEstimate::vertices) return;
  uint64_t triangles = 0;
  for (const Instance& instance : scene.instances)
    triangles += scene.meshes[static_cast<size_t>(instance.mesh)].triangles.size();
  const auto cut = [&](int levels) { return triangles << 2 * levels; };
  if (cut(s.mapSubdivision) <= kMostMapTriangles) return;
  int fits = s.mapSubdivision - 1;
  while (fits >= 0 && cut(fits) > kMostMapTriangles) --fits;
  fail("map-subdivision is {}: the scene's {} triangles become {}, at most are {}: {}",
       s.mapSubdivision, triangles, cut(s.mapSubdivision), kMostMapTriangles,
       fits >= 0 ? fmt::format("{} would do", fits) : "use --map-estimate pixels");
}

}  // namespace ninefold
