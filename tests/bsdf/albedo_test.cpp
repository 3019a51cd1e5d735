// Tabulated albedos against sampled ones.
#include <gtest/gtest.h>

#include "tests/bsdf/materials.h"

namespace ninefold {
namespace {

TEST(LobeAlbedo, OpaqueReflectionIsAccurate) {
  for (const float alpha : {0.0f, 0.002f, 0.03f, 0.1f, 0.33f, 0.7f, 1.0f}) {
    for (const float c : {0.02f, 0.1f, 0.3f, 0.6f, 0.95f}) {
      for (const Vec3 f0 : {Vec3(0.04f), Vec3(1.0f, 0.5f, 0.2f)}) {
        const Bsdf b = metal(alpha, f0);
        const Vec3 error =
            lobeAlbedo(b, Lobe::reflection, c) - sampledAlbedo(b, Lobe::reflection, upward(c));
        EXPECT_LT(glm::length(error), 0.04f) << alpha << " cos " << c;
      }
    }
  }
}

TEST(LobeAlbedo, LayersAreApproximate) {
  for (const float alpha : {0.0f, 0.1f, 0.4f, 1.0f})
    for (const float c : {0.05f, 0.3f, 0.6f, 0.95f})
      for (const Bsdf& b :
           {coated(metal(alpha), 0), coated(metal(0.3f), alpha, 0.5f),
            underSheen(metal(alpha), 0.3f), cloth(std::max(alpha, kLeastSheenAlpha))}) {
        const Vec3 error =
            lobeAlbedo(b, Lobe::reflection, c) - sampledAlbedo(b, Lobe::reflection, upward(c));
        EXPECT_LT(maxComponent(glm::abs(error)), 0.1f) << alpha << " cos " << c;
      }
}

TEST(LobeAlbedo, DielectricsAreApproximate) {
  for (const float alpha : {0.0f, 0.1f, 0.4f, 1.0f}) {
    for (const float c : {0.1f, 0.3f, 0.6f, 0.95f}) {
      for (const float eta : {1.33f, 1.5f, 2.4f}) {
        for (const Lobe lobe : {Lobe::reflection, Lobe::transmission}) {
          const Bsdf b = glass(alpha, eta);
          EXPECT_NEAR(lobeAlbedo(b, lobe, c).x, sampledAlbedo(b, lobe, upward(c)).x, 0.1f)
              << alpha << " cos " << c << " eta " << eta << " lobe " << int(lobe);
        }
      }
    }
  }
}

TEST(LobeAlbedo, LobesThatAreNotThereScatterNothing) {
  EXPECT_TRUE(isBlack(lobeAlbedo(Bsdf{}, Lobe::reflection, 0.5f)));
  EXPECT_TRUE(isBlack(lobeAlbedo(Bsdf{}, Lobe::transmission, 0.5f)));
  Bsdf screen;
  screen.passThrough = 0.25f;
  EXPECT_EQ(lobeAlbedo(screen, Lobe::transmission, 0.5f), Vec3(0.25f));
}

TEST(MeanSheen, IsTheCosineWeightedMeanOfTheAlbedo) {
  for (const float alpha : {0.04f, 0.2f, 1.0f}) {
    float mean = 0;
    constexpr int kSteps = 40;
    for (int i = 0; i < kSteps; ++i) {
      const float c = std::sqrt((static_cast<float>(i) + 0.5f) / kSteps);
      mean += sampledAlbedo(cloth(alpha, Vec3(1)), Lobe::reflection, upward(c), 48).x / kSteps;
    }
    EXPECT_NEAR(meanSheen(alpha), mean, 0.01f) << alpha;
  }
}

TEST(MeanReflection, IsTheCosineWeightedMeanOfTheAlbedo) {
  const Vec3 f0(0.04f, 0.5f, 1.0f);
  for (const float alpha : {0.0f, 0.1f, 0.5f, 1.0f}) {
    Vec3 mean(0);
    constexpr int kSteps = 40;
    for (int i = 0; i < kSteps; ++i) {
      const float c = std::sqrt((static_cast<float>(i) + 0.5f) / kSteps);
      mean += sampledAlbedo(metal(alpha, f0), Lobe::reflection, upward(c), 24) / float(kSteps);
    }
    EXPECT_LT(glm::length(meanReflection(f0, alpha) - mean), 0.01f) << alpha;
  }
  // Schlick's term on a smooth surface: 2 int (1-c)^5 c dc = 1/21.
  EXPECT_NEAR(meanReflection(Vec3(0), 0).x, 1.0f / 21, 1e-3f);
  EXPECT_NEAR(meanReflection(Vec3(1), 0).x, 1.0f, 1e-3f);
}

}  // namespace
}  // namespace ninefold
