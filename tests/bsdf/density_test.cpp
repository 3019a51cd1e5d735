// Sampling and evaluation tell the same story: samples have the density that they claim, and weight
// times density is the value.
#include <gtest/gtest.h>

#include "tests/bsdf/materials.h"
#include "tests/sampling/chi_square.h"

namespace ninefold {
namespace {

struct Case {
  std::string name;
  Bsdf bsdf;
  Lobe lobe;
  Vec3 wo;
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const float cosine : {0.05f, 0.95f}) {
    for (const float alpha : {0.1f, 0.35f, 1.0f}) {
      const std::string at = " alpha " + std::to_string(alpha) + " cos " + std::to_string(cosine);
      // A direction off the axes, so that a swapped x and y shows.
      const Vec3 wo = Vec3(upward(cosine).x * 0.6f, upward(cosine).x * 0.8f, cosine);
      all.push_back({"metal" + at, metal(alpha), Lobe::reflection, wo});
      all.push_back({"glass reflects" + at, glass(alpha, 1.5f), Lobe::reflection, wo});
      all.push_back({"into glass" + at, glass(alpha, 1.5f), Lobe::transmission, wo});
      all.push_back({"out of glass" + at, glass(alpha, 1 / 1.5f), Lobe::transmission, wo});
      all.push_back({"thin" + at, glass(alpha, 1.5f, true), Lobe::transmission, wo});
      Bsdf blended = glass(alpha, 1.3f);
      blended.passThrough = 0.4f;
      blended.transmissionTint = Vec3(0.2f, 0.5f, 0.6f);
      all.push_back({"blended" + at, blended, Lobe::transmission, wo});
      all.push_back({"varnished" + at, coated(metal(alpha), 0), Lobe::reflection, wo});
      all.push_back({"coated" + at, coated(metal(alpha), 0.2f, 0.7f), Lobe::reflection, wo});
      all.push_back({"cloth" + at, cloth(std::max(alpha, kLeastSheenAlpha)), Lobe::reflection, wo});
      all.push_back({"all layers" + at, coated(underSheen(metal(alpha, Vec3(0.04f)), 0.3f), 0.15f),
                     Lobe::reflection, wo});
    }
  }
  return all;
}

// Cells of equal size in height and azimuth around an axis across the plane of incidence: there the
// lobes lie on the equator, where cells are square, and the surface, where densities end, lies on
// cell borders.
constexpr size_t kRows = 40, kColumns = 40;
const Vec3 kAxis(0.8f, -0.6f, 0), kForward(0.6f, 0.8f, 0);

Vec3 sphere(double u, double v) {
  const double z = 2 * u - 1, r = std::sqrt(1 - z * z), phi = 2 * M_PI * v;
  return Vec3(z * DVec3(kAxis) + r * std::cos(phi) * DVec3(kForward) +
              DVec3(0, 0, r * std::sin(phi)));
}

size_t cellOf(Vec3 w) {
  const double v = std::atan2(w.z, glm::dot(w, kForward)) / (2 * M_PI);
  const auto row = static_cast<size_t>(0.5 * (double(glm::dot(w, kAxis)) + 1) * kRows);
  const auto column = static_cast<size_t>((v < 0 ? v + 1 : v) * kColumns);
  return std::min(row, kRows - 1) * kColumns + std::min(column, kColumns - 1);
}

struct Integral {
  double mass = 0;  // of the density
  DVec3 value{0};   // of f |cos|
  double least = 1e30, most = 0;
};

Integral integrateCell(const Case& c, size_t k, int fine) {
  Integral result;
  const double area = 4 * M_PI / double(kRows * kColumns) / (fine * fine);
  for (int q = 0; q < fine * fine; ++q) {
    const double u = (double(k / kColumns) + (q / fine + 0.5) / fine) / kRows;
    const double v = (double(k % kColumns) + (q % fine + 0.5) / fine) / kColumns;
    const LobeValue value = evaluateLobe(c.bsdf, c.lobe, c.wo, sphere(u, v));
    result.mass += value.pdf * area;
    result.value += DVec3(value.value) * area;
    result.least = std::min<double>(result.least, value.pdf);
    result.most = std::max<double>(result.most, value.pdf);
  }
  return result;
}

// Densities of refraction end abruptly where normals would point below the surface, and narrow
// lobes vary inside a cell: such cells get a finer rule.
Integral integrateCell(const Case& c, size_t k) {
  const Integral coarse = integrateCell(c, k, 6);
  const bool flat = coarse.least > 0.7 * coarse.most || coarse.mass < 1e-5;
  return flat ? coarse : integrateCell(c, k, 32);
}

TEST(LobeDensity, SamplesFollowTheirDensityAndWeightsIntegrateToTheValue) {
  const std::vector<Case> all = cases();
  constexpr uint32_t kSamples = 40000;
  for (const Case& c : all) {
    std::vector<double> observed(kRows * kColumns + 1), expected;
    double inside = 0;
    DVec3 value(0);
    for (size_t k = 0; k < kRows * kColumns; ++k) {
      const Integral cell = integrateCell(c, k);
      expected.push_back(cell.mass * kSamples);
      inside += cell.mass;
      value += cell.value;
    }
    // Samples below the surface, at total reflection, or of the straight pass have no density here.
    expected.push_back(std::max(0.0, 1 - inside) * kSamples);
    EXPECT_LT(inside, 1.01) << c.name;
    DVec3 weights(0);
    for (uint32_t i = 0; i < kSamples; ++i) {
      const auto s = sampleLobe(c.bsdf, c.lobe, c.wo, random2(i, 5), random1(i, 6));
      const bool counts = s && !s->smooth;
      ++observed[counts ? cellOf(s->wi) : kRows * kColumns];
      if (counts) weights += DVec3(s->weight) / double(kSamples);
    }
    EXPECT_GT(chiSquareP(observed, expected), sidak(0.01, int(all.size()))) << c.name;
    EXPECT_LT(glm::length(weights - value), 0.02) << c.name;
  }
}

TEST(LobeDensity, EvaluationRepeatsWhatSamplingSaid) {
  for (const Case& c : cases()) {
    for (uint32_t i = 0; i < 2000; ++i) {
      const auto s = sampleLobe(c.bsdf, c.lobe, c.wo, random2(i, 7), random1(i, 8));
      if (!s || s->smooth) continue;
      const LobeValue value = evaluateLobe(c.bsdf, c.lobe, c.wo, s->wi);
      ASSERT_NEAR(value.pdf, s->pdf, 5e-3f * s->pdf + 1e-6f) << c.name;
      const Vec3 expected = s->weight * s->pdf;
      ASSERT_LT(glm::length(value.value - expected), 5e-3f * glm::length(expected) + 1e-6f)
          << c.name;
    }
  }
}

// Nothing may be counted by both: direct sampling of lights sees the rough part only.
TEST(LobeDensity, SmoothLobesHaveNoValue) {
  for (const float eta : {1.0f, 1.5f}) {
    for (const float alpha : {0.0f, 0.5f * kSmoothAlpha}) {
      for (const bool thin : {false, true}) {
        const Bsdf b = glass(alpha, eta, thin);
        const Vec3 wo = upward(0.6f);
        EXPECT_EQ(evaluateLobe(b, Lobe::reflection, wo, Vec3(-wo.x, 0, wo.z)).pdf, 0.0f);
        EXPECT_EQ(evaluateLobe(b, Lobe::transmission, wo, -wo).pdf, 0.0f);
        const auto s = sampleLobe(b, Lobe::transmission, wo, Vec2(0.3f), 0.5f);
        ASSERT_TRUE(s);
        EXPECT_TRUE(s->smooth && s->pdf == 0);
      }
    }
  }
}

}  // namespace
}  // namespace ninefold
