// Whatever the parameters and directions: finite, on the right side, never more than comes in.
#include <gtest/gtest.h>

#include <sstream>

#include "tests/bsdf/materials.h"

namespace ninefold {
namespace {

template <typename T, size_t n>
T pick(const T (&values)[n], uint64_t i, uint64_t stream) {
  return values[hashWords(i, stream) % n];
}

Bsdf extremeBsdf(uint64_t i) {
  const float alphas[] = {0, 1e-8f, kSmoothAlpha, 1.01f * kSmoothAlpha, 0.01f, 0.5f, 1.0f};
  const float etas[] = {1e-6f,      0.1f,   0.5f,  0.6667f, 0.999f, 0.9999999f, 1,
                        1.0000001f, 1.001f, 1.01f, 1.5f,    10,     1e5f,       1e30f};
  const float parts[] = {0, 1e-38f, 1e-7f, 0.3f, 1};
  Bsdf b;
  b.alpha = pick(alphas, i, 1);
  b.eta = pick(etas, i, 2);
  b.reflects = hashWords(i, 3) % 4 != 0;
  b.dielectric = hashWords(i, 4) % 4 != 0;
  b.thin = hashWords(i, 5) % 2 == 0;
  b.f0 = Vec3(pick(parts, i, 6), pick(parts, i, 7), 0.04f);
  b.reflectionTint = Vec3(pick(parts, i, 8), 1, 1);
  b.passThrough = hashWords(i, 9) % 2 ? pick(parts, i, 10) : 0.0f;
  if (!b.dielectric && hashWords(i, 13) % 2 == 0) {
    b.layered = true;
    b.coat = pick(parts, i, 14), b.coatAlpha = pick(alphas, i, 15);
    if (b.coatAlpha < kSmoothAlpha) b.coatAlpha = 0;
    b.sheen = Vec3(pick(parts, i, 16), 0, pick(parts, i, 17));
    b.sheenAlpha = std::max(pick(alphas, i, 18), kLeastSheenAlpha);
  }
  b.transmissionTint = (1 - b.passThrough) * Vec3(pick(parts, i, 11), pick(parts, i, 12), 1);
  return b;
}

Vec3 extremeDirection(uint64_t i, uint64_t stream) {
  const float cosines[] = {1e-20f, 1e-7f, 1e-4f, 0.1f, 0.5f, 0.745356f, 0.999999f, 1};
  const float c = random1(i, stream) < 0.3f ? std::max(random1(i, stream + 1), 1e-7f)
                                            : pick(cosines, i, stream + 2);
  const float phi = 2 * kPi * random1(i, stream + 3);
  return Vec3(upward(c).x * std::cos(phi), upward(c).x * std::sin(phi), c);
}

float extremeUnit(uint64_t i, uint64_t stream) {
  const float ends[] = {0, 0x1p-24f, 0.5f, 1 - 0x1p-24f};
  return random1(i, stream) < 0.5f ? random1(i, stream + 1) : pick(ends, i, stream + 2);
}

std::string describe(const Bsdf& b, Vec3 wo) {
  std::ostringstream out;
  out << "alpha " << b.alpha << " eta " << b.eta << " dielectric " << b.dielectric << " thin "
      << b.thin << " pass " << b.passThrough << " wo " << wo.x << " " << wo.y << " " << wo.z;
  return out.str();
}

bool isFraction(Vec3 v, float most = 1) {
  return isFinite(v) && glm::min(v.x, glm::min(v.y, v.z)) >= 0 && maxComponent(v) <= most + 1e-4f;
}

TEST(Robustness, SamplesOfExtremeSurfacesStayFinite) {
  for (uint64_t i = 0; i < 100000; ++i) {
    const Bsdf b = extremeBsdf(i);
    const Vec3 wo = extremeDirection(i, 20);
    const Vec2 u(extremeUnit(i, 30), extremeUnit(i, 40));
    const Lobe lobe = i % 2 ? Lobe::reflection : Lobe::transmission;
    const auto s = sampleLobe(b, lobe, wo, u, extremeUnit(i, 50));
    if (!s) continue;
    ASSERT_NEAR(glm::length(s->wi), 1.0f, 1e-5f) << describe(b, wo);
    ASSERT_TRUE(lobe == Lobe::reflection ? s->wi.z > 0 : s->wi.z < 0) << describe(b, wo);
    ASSERT_TRUE(isFraction(s->weight, b.layered ? 8 : 1) && !isBlack(s->weight))
        << describe(b, wo) << " " << s->weight.x;
    ASSERT_TRUE(std::isfinite(s->pdf) && (s->smooth ? s->pdf == 0 : s->pdf > 0)) << describe(b, wo);
    const LobeValue value = evaluateLobe(b, lobe, wo, s->wi);
    ASSERT_TRUE(isFinite(value.value) && std::isfinite(value.pdf)) << describe(b, wo);
  }
}

TEST(Robustness, EvaluationAndAlbedoOfExtremeSurfacesStayFinite) {
  for (uint64_t i = 0; i < 100000; ++i) {
    const Bsdf b = extremeBsdf(i);
    const Vec3 wo = extremeDirection(i, 60), wi = extremeDirection(i, 70);
    for (const Lobe lobe : {Lobe::reflection, Lobe::transmission}) {
      for (const Vec3 w : {wi, -wi, wo, -wo}) {
        const LobeValue value = evaluateLobe(b, lobe, wo, w);
        ASSERT_TRUE(isFinite(value.value) && std::isfinite(value.pdf)) << describe(b, wo);
        ASSERT_TRUE(value.value.x >= 0 && value.pdf >= 0) << describe(b, wo);
        const bool wrongSide = (lobe == Lobe::reflection) != (w.z > 0);
        ASSERT_TRUE(!wrongSide || value.pdf == 0) << describe(b, wo);
      }
      ASSERT_TRUE(isFraction(lobeAlbedo(b, lobe, wo.z))) << describe(b, wo);
    }
  }
}

}  // namespace
}  // namespace ninefold
