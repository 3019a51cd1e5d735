// expect.h: pictures held against values that are known, for every estimator there is.
#pragma once

#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "tests/gi/render.h"

namespace ninefold::testing {

inline std::string number(double x) {
  std::ostringstream out;
  out << x;
  return out.str();
}

struct Estimator {
  const char* name;
  Settings settings;
};

// Both methods, without systematic error but for the photon radius (1 % of R, stated by each test).
inline std::vector<Estimator> estimators(int side = 8, int pathLength = 0) {
  Estimator reference{"path tracer", small(Method::pathTrace, side)};
  Estimator radiosity{"instant radiosity", small(Method::instantRadiosity, side)};
  radiosity.settings.interleave = {2, 2};
  radiosity.settings.directVpls = 16, radiosity.settings.indirectVpls = 64;
  radiosity.settings.photons = 2000, radiosity.settings.photonRadius = 0.01f;
  for (Estimator* e : {&reference, &radiosity})
    e->settings.pathLength = pathLength, e->settings.specularDepth = 128;
  return {reference, radiosity};
}

struct Tolerance {
  int frames = 64;
  double bias = 1e-4;   // relative, added to five standard errors
  double error = 0.01;  // the standard error itself stays below this, relative
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
  for (const Estimator& e : all)
    expectMean(render(tracer, e.settings, t.frames), expected, t, what + " by " + e.name);
}

// 1 + a + ... + a^n, or the whole series for n = 0: radiance in a furnace of albedo a, emission 1.
inline double furnaceRadiance(double albedo, int pathLength = 0) {
  if (pathLength == 0) return 1 / (1 - albedo);
  return (1 - std::pow(albedo, pathLength + 1)) / (1 - albedo);
}

}  // namespace ninefold::testing
