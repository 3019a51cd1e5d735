// Energy and symmetry of the lobes.
#include <gtest/gtest.h>

#include "tests/bsdf/materials.h"

namespace ninefold {
namespace {

Vec3 randomDirection(uint64_t i, uint64_t stream) {
  const Vec2 u = random2(i, stream);
  const float c = 0.02f + 0.98f * u.x, phi = 2 * kPi * u.y;
  return Vec3(upward(c).x * std::cos(phi), upward(c).x * std::sin(phi), c);
}

Vec3 bsdfValue(const Bsdf& b, Lobe lobe, Vec3 wo, Vec3 wi) {
  return evaluateLobe(b, lobe, wo, wi).value / std::abs(wi.z);
}

void expectNear(Vec3 a, Vec3 b, float relative, const char* what) {
  EXPECT_LE(glm::length(a - b), relative * glm::length(a + b) + 3e-5f) << what;
}

TEST(Reciprocity, ReflectionIsSymmetric) {
  for (uint64_t i = 0; i < 5000; ++i) {
    const float alpha = 0.05f + 0.95f * random1(i, 1);
    const Vec3 wo = randomDirection(i, 2), wi = randomDirection(i, 3);
    for (const Bsdf& b :
         {metal(alpha), glass(alpha, 1.5f), glass(alpha, 0.7f), glass(alpha, 1.4f, true),
          coated(metal(alpha), 0), coated(metal(0.2f), alpha), cloth(alpha),
          coated(underSheen(metal(alpha), 0.3f), 0.1f)}) {
      expectNear(bsdfValue(b, Lobe::reflection, wo, wi), bsdfValue(b, Lobe::reflection, wi, wo),
                 1e-3f, "reflection");
    }
    const Bsdf thin = glass(alpha, 1.5f, true);
    expectNear(bsdfValue(thin, Lobe::transmission, wo, -wi),
               bsdfValue(thin, Lobe::transmission, wi, -wo), 1e-3f, "thin transmission");
  }
}

// For basic radiance L/n^2: f(wo, wi; eta) = eta^2 f(wi, wo; 1/eta), seen from the other side.
TEST(Reciprocity, RefractionIsSymmetricInBasicRadiance) {
  int seen = 0;
  for (uint64_t i = 0; i < 20000; ++i) {
    const float alpha = 0.1f + 0.9f * random1(i, 4), eta = 1.05f + 1.5f * random1(i, 5);
    const Vec3 wo = randomDirection(i, 6), wi = -randomDirection(i, 7);
    const Vec3 into = bsdfValue(glass(alpha, eta), Lobe::transmission, wo, wi);
    const Vec3 out = bsdfValue(glass(alpha, 1 / eta), Lobe::transmission, -wi, -wo);
    expectNear(into, eta * eta * out, 2e-3f, "refraction");
    seen += into.x > 1e-3f;
  }
  EXPECT_GT(seen, 1000);
}

TEST(Energy, SmoothInterfaceSplitsLightWithoutLoss) {
  for (const float eta : {0.5f, 0.67f, 1.0f, 1.0001f, 1.33f, 2.4f, 10.0f}) {
    for (const bool thin : {false, true}) {
      for (float c = 0.001f; c < 1; c += 0.01f) {
        const Bsdf b = glass(0, eta, thin);
        const auto r = sampleLobe(b, Lobe::reflection, upward(c), Vec2(0.5f), 0.5f);
        const auto t = sampleLobe(b, Lobe::transmission, upward(c), Vec2(0.5f), 0.5f);
        EXPECT_NEAR((r ? r->weight.x : 0) + (t ? t->weight.x : 0), 1.0f, 1e-5f) << c << " " << eta;
      }
    }
  }
}

TEST(Energy, SmoothRefractionObeysSnell) {
  for (const float eta : {0.7f, 1.33f, 2.4f}) {
    for (float c = 0.01f; c < 1; c += 0.03f) {
      const Vec3 wo = upward(c);
      const auto t = sampleLobe(glass(0, eta), Lobe::transmission, wo, Vec2(0.5f), 0.5f);
      if (!t) {
        EXPECT_GE(wo.x, eta * 0.9999f);  // total internal reflection
        continue;
      }
      EXPECT_NEAR(eta * t->wi.x, -wo.x, 1e-5f);
      EXPECT_LT(t->wi.z, 0.0f);
      EXPECT_NEAR(glm::length(t->wi), 1.0f, 1e-6f);
    }
  }
}

// A thin wall is a stack of two faces: T/(1-R) and so on, summed over the bounces between them.
TEST(Energy, ThinWallsSumTheBouncesBetweenTheirFaces) {
  const float f = fresnelDielectric(0.4f, 1.5f);
  float back = f, bounce = (1 - f) * (1 - f) * f;
  for (int i = 0; i < 50; ++i, bounce *= f * f) back += bounce;
  const Bsdf b = glass(0, 1.5f, true);
  EXPECT_NEAR(sampleLobe(b, Lobe::reflection, upward(0.4f), Vec2(0), 0)->weight.x, back, 1e-6f);
  const auto through = sampleLobe(b, Lobe::transmission, upward(0.4f), Vec2(0), 0);
  EXPECT_NEAR(through->weight.x, 1 - back, 1e-6f);
  EXPECT_EQ(through->wi, -upward(0.4f));
}

// The least rough surfaces do what smooth ones do: Fresnel and tint are in both, and bend alike.
TEST(Energy, RoughLobesTendToSmoothOnes) {
  for (const float c : {0.2f, 0.5f, 0.9f}) {
    for (const Bsdf& rough :
         {metal(0.002f), glass(0.002f, 1.5f), glass(0.002f, 1 / 1.5f), glass(0.002f, 1.5f, true)}) {
      for (const Lobe lobe : {Lobe::reflection, Lobe::transmission}) {
        Bsdf smooth = rough;
        smooth.alpha = 0;
        const auto limit = sampleLobe(smooth, lobe, upward(c), Vec2(0.5f), 0.5f);
        const Vec3 albedo = sampledAlbedo(rough, lobe, upward(c), 16);
        EXPECT_LT(glm::length(albedo - (limit ? limit->weight : Vec3(0))), 0.01f) << c;
        const auto sample = sampleLobe(rough, lobe, upward(c), Vec2(0.5f), 0.5f);
        ASSERT_EQ(limit.has_value(), sample.has_value()) << c;
        EXPECT_LT(limit ? glm::distance(limit->wi, sample->wi) : 0.0f, 0.03f) << c;
      }
    }
  }
}

TEST(Energy, WeightsAndAlbedosNeverExceedOne) {
  for (const float alpha : {0.0f, 0.002f, 0.05f, 0.3f, 1.0f}) {
    for (const float eta : {0.4f, 0.67f, 1.001f, 1.5f, 10.0f}) {
      for (const float c : {1e-6f, 0.01f, 0.2f, 0.7f, 1.0f}) {
        Vec3 sum(0);
        for (const Lobe lobe : {Lobe::reflection, Lobe::transmission}) {
          const Bsdf b = glass(alpha, eta);
          for (uint64_t i = 0; i < 500; ++i) {
            const auto s = sampleLobe(b, lobe, upward(c), random2(i, 9), 0.5f);
            ASSERT_LE(s ? maxComponent(s->weight) : 0.0f, 1.0f + 1e-5f);
          }
          sum += sampledAlbedo(b, lobe, upward(c), 16);
        }
        EXPECT_LE(sum.x, 1.001f) << alpha << " " << eta << " " << c;
      }
    }
  }
}

// White furnace of a perfect metal: what single scattering leaves. At alpha = 1 and normal
// incidence c = cos_i is uniform in (-1, 1), c > 0 survives with weight 2c/(1 + c): mean 1 - ln 2.
TEST(Energy, SingleScatteringLosesWhatTheTableSays) {
  const struct {
    float alpha;
    float albedo[3];  // at the cosines below
  } table[] = {{0.01f, {0.994f, 1.000f, 1.000f}},
               {0.04f, {0.929f, 0.995f, 0.997f}},
               {0.25f, {0.892f, 0.857f, 0.916f}},
               {0.5f, {0.860f, 0.698f, 0.688f}},
               {1.0f, {0.760f, 0.451f, 1 - std::log(2.0f)}}};
  const float cosines[] = {0.1f, 0.5f, 1.0f};
  for (const auto& row : table) {
    for (int k = 0; k < 3; ++k) {
      const Vec3 a = sampledAlbedo(metal(row.alpha, Vec3(1)), Lobe::reflection, upward(cosines[k]));
      EXPECT_NEAR(a.x, row.albedo[k], 0.003f) << row.alpha << " cos " << cosines[k];
    }
  }
}

// A coat gives F and takes F from what is below; nothing is gained at any angle.
TEST(Energy, ASmoothCoatOverAPerfectMirrorLosesNothing) {
  for (const float weight : {0.3f, 1.0f})
    for (const float c : {0.02f, 0.2f, 0.5f, 1.0f}) {
      const Bsdf b = coated(metal(0, Vec3(1)), 0, weight);
      Vec3 sum(0);
      constexpr int kSteps = 4000;
      for (int i = 0; i < kSteps; ++i) {
        const float u = (static_cast<float>(i) + 0.5f) / kSteps;
        const auto s = sampleLobe(b, Lobe::reflection, upward(c), Vec2(0.5f), u);
        if (s) sum += s->weight / float{kSteps};
      }
      EXPECT_NEAR(sum.x, 1, 2e-3f) << weight << " cos " << c;
    }
}

TEST(Energy, LayersNeverGiveMoreThanComesIn) {
  for (const float alpha : {0.0f, 0.05f, 0.3f, 1.0f})
    for (const float other : {0.0f, 0.1f, 0.6f, 1.0f})
      for (const float c : {0.01f, 0.1f, 0.4f, 1.0f}) {
        const Bsdf surfaces[] = {coated(metal(alpha, Vec3(1)), other),
                                 underSheen(metal(alpha, Vec3(1)), std::max(other, 0.04f)),
                                 cloth(std::max(other, 0.04f), Vec3(1))};
        for (const Bsdf& b : surfaces) {
          const Vec3 albedo = sampledAlbedo(b, Lobe::reflection, upward(c));
          EXPECT_LE(maxComponent(albedo), 1.01f) << alpha << " " << other << " cos " << c;
        }
      }
}

TEST(Energy, ACoatOfWeightZeroIsNone) {
  const Bsdf plain = metal(0.3f), none = coated(plain, 0.1f, 0);
  for (uint64_t i = 0; i < 200; ++i) {
    const Vec3 wo = randomDirection(i, 11), wi = randomDirection(i, 12);
    const LobeValue a = evaluateLobe(plain, Lobe::reflection, wo, wi);
    const LobeValue b = evaluateLobe(none, Lobe::reflection, wo, wi);
    EXPECT_NEAR(a.pdf, b.pdf, 1e-5f * a.pdf);
    EXPECT_LE(glm::length(a.value - b.value), 1e-5f * glm::length(a.value));
  }
}

// The rim of cloth: much more at grazing than from above.
TEST(Energy, SheenIsARim) {
  for (const float alpha : {0.04f, 0.25f}) {
    const Bsdf b = cloth(alpha, Vec3(1));
    EXPECT_GT(sampledAlbedo(b, Lobe::reflection, upward(0.05f)).x,
              10 * sampledAlbedo(b, Lobe::reflection, upward(0.9f)).x);
  }
}

TEST(Energy, IndexOneIsInvisible) {
  for (const float alpha : {0.0f, 0.3f, 1.0f}) {
    for (const bool thin : {false, true}) {
      for (const float c : {1e-7f, 0.3f, 1.0f}) {
        const Bsdf b = glass(alpha, 1.0f, thin);
        EXPECT_FALSE(sampleLobe(b, Lobe::reflection, upward(c), Vec2(0.3f), 0.3f));
        const auto t = sampleLobe(b, Lobe::transmission, upward(c), Vec2(0.3f), 0.3f);
        ASSERT_TRUE(t);
        EXPECT_EQ(t->wi, -upward(c));
        EXPECT_EQ(t->weight, Vec3(1));
      }
    }
  }
}

// Alpha blending: straight pass and refraction are told apart by uLobe, and the mean adds them up.
TEST(Energy, StraightPassAddsToRefraction) {
  Bsdf b = glass(0, 1.5f);
  b.passThrough = 0.3f;
  b.transmissionTint = 0.7f * Vec3(1, 0.5f, 0);
  const Vec3 wo = upward(0.8f);
  const float t = 1 - fresnelDielectric(0.8f, 1.5f);
  EXPECT_LT(
      glm::length(sampledAlbedo(b, Lobe::transmission, wo) - (Vec3(0.3f) + t * b.transmissionTint)),
      0.02f);
  Bsdf screen;
  screen.passThrough = 0.5f;
  const auto s = sampleLobe(screen, Lobe::transmission, wo, Vec2(0.5f), 0.999f);
  ASSERT_TRUE(s && s->smooth);
  EXPECT_EQ(s->weight, Vec3(0.5f));
  EXPECT_FALSE(sampleLobe(Bsdf{}, Lobe::transmission, wo, Vec2(0.5f), 0.5f));
  EXPECT_FALSE(sampleLobe(Bsdf{}, Lobe::reflection, wo, Vec2(0.5f), 0.5f));
}

}  // namespace
}  // namespace ninefold
