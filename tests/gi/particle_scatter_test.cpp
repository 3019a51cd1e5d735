// Particles scatter at interpolated normals with the very f of the eye paths. Of a surface that is
// lit by basic radiance 1 from a set of directions L, the flux into a set V is, by eye paths from V
// and by particles from L (n: index where the set lies, cosines to the geometric normal),
//
//   n_V^2  int_V |cos v| E[weight; w in L] dv  =  n_L^2  int_L |cos l| E[weight; w in V] dl
//
// for all pairs of twelve sets of each side's directions, in the mean over a quarter of a million
// of both.
#include "common/gi/light/particle_scatter.h"

#include <gtest/gtest.h>

#include <random>

#include "common/sampling/sampler.h"
#include "common/sampling/warp.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

constexpr int kRings = 3, kSectors = 4, kSets = 2 * kRings * kSectors;
constexpr int kSamples = 1 << 18;
const Vec3 kUp(0, 0, 1);

// Rings of equal projected area, on the front, then on the back.
int setOf(Vec3 w) {
  const int ring = std::min(static_cast<int>(kRings * (1 - w.z * w.z)), kRings - 1);
  const float turn = std::atan2(w.y, w.x) / (2 * kPi) + 0.5f;
  const int sector = std::min(static_cast<int>(kSectors * turn), kSectors - 1);
  return ((w.z > 0 ? 0 : kRings) + ring) * kSectors + sector;
}

struct Mean {
  double sum = 0, squares = 0;
  void add(double x) { sum += x, squares += x * x; }
  double value() const { return sum / kSamples; }
  double variance() const { return (squares / kSamples - value() * value()) / kSamples; }
};

using Flux2 = std::vector<Mean>;  // kSets x kSets

struct Random {
  std::mt19937 engine{7};
  float operator()() { return unitFloat(static_cast<uint32_t>(engine())); }
  Vec2 square() {
    const float x = (*this)();
    return Vec2(x, (*this)());
  }
};

struct Case {
  Material material;
  Lobe lobe;
  float tilt;
};

class ParticleScatter : public ::testing::Test {
 protected:
  // What arrives from `wo`, in one of both ways; index: n^2 on that side.
  static void addSample(const Shader& shader, const Case& c, Vec3 wo, bool particle, Random& random,
                        Flux2& flux) {
    SurfacePoint s;
    s.geometricNormal = kUp;
    s.shadingNormal = Vec3(std::sin(c.tilt), 0, std::cos(c.tilt));
    const ShadingPoint p = shader.shade(s, wo, {});
    const float side = c.lobe == Lobe::reflection ? 1.0f : -1.0f;
    const Vec2 u = random.square();
    const float uLobe = random(), uNormal = random();
    Vec3 wi(0), weight(0);
    if (particle) {
      const auto scattered = scatterParticle(p, c.lobe, u, uLobe, uNormal);
      if (!scattered) return;
      wi = scattered->wi, weight = scattered->weight;
    } else {  // as in eye_path.cpp and path_tracer.cpp
      const auto sample = sampleLobe(p.bsdf, c.lobe, p.localWo(), u, uLobe);
      if (!sample) return;
      wi = p.frame.toWorld(sample->wi), weight = sample->weight;
      if (side * glm::dot(wi, p.ng) <= 0) return;
    }
    const double n = wo.z < 0 && c.lobe == Lobe::transmission ? double(c.material.ior) : 1;
    const int from = setOf(wo), to = setOf(wi);
    flux[static_cast<size_t>(particle ? from * kSets + to : to * kSets + from)].add(
        n * n * double(weight.x));
  }

  static void expectSameFlux(const Case& c) {
    Scene scene;
    scene.materials = {c.material};
    const Shader shader(scene);
    Flux2 eye(kSets * kSets), light(kSets * kSets);
    Random random;
    for (int i = 0; i < kSamples; ++i)
      for (const bool particle : {false, true}) {
        Vec3 wo = squareToCosineHemisphere(random.square());
        if (random() < 0.5f) wo.z = -wo.z;
        if (wo.z != 0) addSample(shader, c, wo, particle, random, particle ? light : eye);
      }
    double all = 0;
    for (size_t i = 0; i < eye.size(); ++i) {
      all += eye[i].value();
      const double error = std::sqrt(eye[i].variance() + light[i].variance());
      EXPECT_NEAR(eye[i].value(), light[i].value(), 5 * error + 1e-5)
          << "from set " << i / kSets << " to set " << i % kSets << ", tilt " << c.tilt;
    }
    EXPECT_GT(all, 0.2) << "hardly any light to compare";
  }
};

Material metal(float roughness) {
  Material m = testing::mirror(Vec3(0.9f));
  m.roughness = roughness;
  return m;
}

TEST_F(ParticleScatter, RoughMetalWithLeaningNormals) {
  for (const float tilt : {0.0f, 0.1f, 0.5f}) expectSameFlux({metal(0.5f), Lobe::reflection, tilt});
}

TEST_F(ParticleScatter, MirrorsWithLeaningNormals) {
  for (const float tilt : {0.1f, 0.5f}) expectSameFlux({metal(0), Lobe::reflection, tilt});
}

TEST_F(ParticleScatter, GlassWithLeaningNormals) {
  for (const float tilt : {0.1f, 0.5f}) {
    expectSameFlux({testing::glass(1.5f), Lobe::transmission, tilt});
    expectSameFlux({testing::glass(1.5f), Lobe::reflection, tilt});
  }
}

TEST_F(ParticleScatter, FrostedGlassWithLeaningNormals) {
  Material frosted = testing::glass(1.4f);
  frosted.roughness = 0.5f;
  expectSameFlux({frosted, Lobe::transmission, 0.3f});
}

}  // namespace
}  // namespace ninefold
