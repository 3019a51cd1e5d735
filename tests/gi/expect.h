// expect.h: pictures held against values that are known, by every method of the table
// (common/scene/methods.h).
#pragma once

#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "common/scene/methods.h"
#include "tests/gi/render.h"

namespace ninefold::testing {

inline std::string number(double x) {
  std::ostringstream out;
  out << x;
  return out.str();
}

struct Estimator {
  std::string name;
  Settings settings;

  const MethodFacts& facts() const { return factsOf(settings.method); }
  // A picture without light that pixels share needs more of them for the same error.
  int frames(int shared, int unshared) const { return facts().isUnfiltered ? unshared : shared; }
};

// Without systematic error but for the photon radius (1 % of R, stated by each test).
inline Estimator estimator(const MethodFacts& facts, int side = 8, int pathLength = 0) {
  Estimator e{facts.title, small(facts.method, side)};
  e.settings.interleave = {2, 2};
  e.settings.directVpls = 16, e.settings.indirectVpls = 64;
  e.settings.resampling = 3;
  e.settings.photons = 2000, e.settings.photonRadius = 0.01f;
  e.settings.pathLength = pathLength, e.settings.specularDepth = 128;
  e.settings.fieldPhotons = 16384;
  e.settings.photonPool = 16384, e.settings.photonGroups = 16, e.settings.elementSize = 0.12f;
  return e;
}

// One of every method that has light of its own.
inline std::vector<Estimator> estimators(int side = 8, int pathLength = 0) {
  std::vector<Estimator> all;
  for (const MethodFacts& facts : allMethods())
    if (!facts.isChoice) all.push_back(estimator(facts, side, pathLength));
  return all;
}

// The photon map with light at the vertices of a finer mesh.
inline Estimator mapAtVertices(int side = 8, int pathLength = 0) {
  Estimator e = estimator(factsOf(Method::photonMap), side, pathLength);
  e.name += " at vertices";
  e.settings.mapEstimate = MapEstimate::vertices, e.settings.mapSubdivision = 4;
  return e;
}

// What the others are held against: without bias, and with a loop over pixels of its own.
inline constexpr Method kReference = Method::pathTrace;
inline Estimator reference(int side = 8, int pathLength = 0) {
  return estimator(factsOf(kReference), side, pathLength);
}

// Those that converge to the truth.
inline std::vector<Estimator> unbiased(std::vector<Estimator> all) {
  std::erase_if(all, [](const Estimator& e) { return e.facts().bias != nullptr; });
  return all;
}

inline std::vector<Estimator> othersThanReference(int side = 8, int pathLength = 0) {
  auto all = estimators(side, pathLength);
  std::erase_if(all, [](const Estimator& e) { return e.settings.method == kReference; });
  return all;
}

// For tests of what its VPLs and photons do one by one.
inline Estimator radiosity(int side = 8, int pathLength = 0) {
  return estimator(factsOf(Method::instantRadiosity), side, pathLength);
}

struct Tolerance {
  int frames = 64;
  double bias = 1e-4;   // relative, added to five standard errors
  double error = 0.01;  // the standard error itself stays below this, relative
  double blur = 0;      // further bias of methods whose facts name one, relative
};

inline void expectMean(const Rendered& image, double expected, const Tolerance& t,
                       const std::string& what) {
  EXPECT_NEAR(image.grey(), expected, 5 * image.error() + t.bias * expected)
      << what << ": " << image.grey() << " +- " << image.error();
  EXPECT_LT(image.error(), t.error * expected) << what;
  for (const Vec3& p : image.pixels)
    ASSERT_TRUE(isFinite(p) && p.x >= 0 && p.y >= 0 && p.z >= 0) << what;
}

// The mean of the picture by each estimator.
inline void expectRadiance(const Scene& scene, const std::vector<Estimator>& all, double expected,
                           const Tolerance& t = {}, const std::string& what = "") {
  const Tracer tracer(scene, Isa::automatic);
  for (const Estimator& e : all) {
    Tolerance allowed = t;
    if (e.facts().bias != nullptr) allowed.bias += t.blur, allowed.error += t.blur;
    expectMean(render(tracer, e.settings, t.frames), expected, allowed, what + " by " + e.name);
  }
}

// 1 + a + ... + a^n, or the whole series for n = 0: radiance in a furnace of albedo a, emission 1.
inline double furnaceRadiance(double albedo, int pathLength = 0) {
  if (pathLength == 0) return 1 / (1 - albedo);
  return (1 - std::pow(albedo, pathLength + 1)) / (1 - albedo);
}

}  // namespace ninefold::testing
