// The smooth dielectric interface: known values, both sides, extremes.
#include <gtest/gtest.h>

#include <limits>

#include "tests/bsdf/materials.h"

namespace ninefold {
namespace {

TEST(Fresnel, KnownValues) {
  EXPECT_NEAR(fresnelDielectric(1.0f, 1.5f), 0.04f, 1e-6f);
  EXPECT_NEAR(fresnelDielectric(1.0f, 1.0f / 1.5f), 0.04f, 1e-6f);
  EXPECT_NEAR(fresnelDielectric(1.0f, 10.0f), 81.0f / 121.0f, 1e-6f);
  EXPECT_NEAR(fresnelDielectric(0.5f, 1.5f), 0.08919f,
              1e-5f);  // 60 degrees: r_s^2 = 0.17658, r_p^2 = 0.0018
  EXPECT_EQ(fresnelDielectric(0.0f, 1.5f), 1.0f);
  EXPECT_EQ(fresnelDielectric(-0.3f, 1.5f), fresnelDielectric(0.3f, 1.5f));
}

// At Brewster's angle, tan = eta, only one polarization returns: F = ((eta^2-1)/(eta^2+1))^2 / 2.
TEST(Fresnel, BrewsterAngleLeavesOnePolarization) {
  for (const float eta : {0.6f, 1.3f, 1.5f, 2.4f}) {
    const float r = (eta * eta - 1) / (eta * eta + 1);
    EXPECT_NEAR(fresnelDielectric(1 / std::sqrt(1 + eta * eta), eta), 0.5f * r * r, 1e-6f);
  }
}

TEST(Fresnel, ReflectsTheSameFromBothSides) {
  for (const float eta : {1.05f, 1.33f, 1.5f, 2.4f}) {
    for (float c = 0.05f; c <= 1; c += 0.05f) {
      const float inside = std::sqrt(1 - (1 - c * c) / (eta * eta));
      EXPECT_NEAR(fresnelDielectric(c, eta), fresnelDielectric(inside, 1 / eta), 2e-4f);
    }
  }
}

TEST(Fresnel, TotalInternalReflectionIsTotal) {
  const float critical = std::sqrt(1 - 1 / (1.5f * 1.5f));  // cos of the critical angle of glass
  EXPECT_EQ(fresnelDielectric(critical - 1e-4f, 1 / 1.5f), 1.0f);
  EXPECT_EQ(fresnelDielectric(0.0f, 1 / 1.5f), 1.0f);
  EXPECT_LT(fresnelDielectric(critical + 1e-2f, 1 / 1.5f), 0.8f);
}

TEST(Fresnel, EveryArgumentGivesAFraction) {
  for (const float eta : {0.0f, 1e-30f, 1e-6f, 0.1f, 0.999999f, 1.0f, 1.000001f, 1.5f, 10.0f, 1e5f,
                          1e10f, 1e30f, std::numeric_limits<float>::infinity()}) {
    for (const float c : {0.0f, 1e-30f, 1e-7f, 1e-3f, 0.5f, 1.0f, 1.0f + 1e-6f}) {
      const float f = fresnelDielectric(c, eta);
      EXPECT_TRUE(f >= 0 && f <= 1) << "cos " << c << " eta " << eta << " F " << f;
    }
    const float mean = meanFresnelDielectric(eta);
    EXPECT_TRUE(mean >= 0 && mean <= 1) << eta;
  }
  EXPECT_EQ(fresnelDielectric(0.3f, 1.0f), 0.0f);
  EXPECT_EQ(meanFresnelDielectric(1.0f), 0.0f);
}

// Walsh's closed form of the mean (1926), in double precision.
double walsh(double n) {
  const double n2 = n * n, n4 = n2 * n2, p = n2 + 1, q = n4 - 1;
  return 0.5 + (n - 1) * (3 * n + 1) / (6 * (n + 1) * (n + 1)) +
         n2 * (n2 - 1) * (n2 - 1) / (p * p * p) * std::log((n - 1) / (n + 1)) -
         2 * n2 * n * (n2 + 2 * n - 1) / (p * q) + 8 * n4 * (n4 + 1) / (p * q * q) * std::log(n);
}

TEST(Fresnel, MeanOverTheHemisphereIsWalshs) {
  for (const float n : {1.01f, 1.1f, 1.33f, 1.5f, 2.0f, 2.4f, 10.0f, 100.0f}) {
    EXPECT_NEAR(meanFresnelDielectric(n), walsh(n), 2e-4) << n;
    EXPECT_NEAR(meanFresnelDielectric(1 / n), 1 - (1 - walsh(n)) / (double(n) * n), 3e-4) << n;
  }
}

}  // namespace
}  // namespace ninefold
