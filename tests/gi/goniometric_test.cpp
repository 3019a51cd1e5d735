// Goniometric lights by every method: closed forms where there are some, the path tracer elsewhere.
#include "common/gi/light/emission.h"
#include "common/sampling/sampler.h"
#include "tests/gi/expect.h"
#include "tests/gi/make_scene.h"
#include "tests/sampling/chi_square.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

constexpr double kAlbedo = 0.5, kExactPi = 3.14159265358979323846;

PunctualLight lampAt(Vec3 position, float intensity) {
  PunctualLight light;
  light.position = position, light.direction = Vec3(0, -1, 0), light.intensity = Vec3(intensity);
  return light;
}

// A floor in y = 0, and an eye that looks at one point of it.
SceneBuilder floorSeenAt(Vec3 point) {
  SceneBuilder b;
  b.quad(b.material(testing::matte(Vec3(0.5f))), Vec3(-3, 0, 3), Vec3(6, 0, 0), Vec3(0, 0, -6));
  b.camera(point + Vec3(0.1f, 0.2f, 0.3f), point, 1e-3f);
  return b;
}

std::vector<float> everyDegree(int last) {
  std::vector<float> angles;
  for (int i = 0; i <= last; ++i) angles.push_back(static_cast<float>(i));
  return angles;
}

// I = I0 cos(theta), as of a small Lambertian disc that faces down: E = I0 cos^2/d^2. A table of
// whole degrees is off by (pi/180)^2/8 = 4e-5.
TEST(Goniometric, ACosineLightsAsALambertianDiscDoes) {
  const Vec3 x(0.5f, 0, 0);
  SceneBuilder b = floorSeenAt(x);
  b.goniometric(lampAt(Vec3(0, 1, 0), 2), everyDegree(90), {0, 360},
                [](float theta, float) { return std::max(0.0f, std::cos(theta * kPi / 180)); });
  const double expected = kAlbedo / kExactPi * 2 * (1 / 1.25) / 1.25;
  testing::expectRadiance(b.build(), testing::estimators(8, 1), expected,
                          {.frames = 4, .bias = 2e-3});
}

// Where one is much brighter to one side, and hangs in a ceiling that it is flush with.
TEST(Goniometric, OneInTheCeilingLightsTheSideThatItsTableSays) {
  for (const float side : {1.0f, -1.0f}) {
    const Vec3 x(0.5f * side, 0, 0);
    SceneBuilder b = floorSeenAt(x);
    b.quad(b.material(testing::matte(Vec3(0))), Vec3(-2, 1, -2), Vec3(4, 0, 0), Vec3(0, 0, 4));
    b.goniometric(lampAt(Vec3(0, 1, 0), 1), {0, 90}, {0, 90, 180, 270, 360},
                  [](float, float phi) { return phi == 180 ? 0.25f : 1.0f; });
    const double f = side > 0 ? 1 : 0.25;
    const double expected = kAlbedo / kExactPi * f / std::pow(1.25, 1.5);
    testing::expectRadiance(b.build(), testing::estimators(8, 1), expected,
                            {.frames = 4, .bias = 2e-3}, "side " + testing::number(double(side)));
  }
}

// A profile of 1 everywhere is a point light: the same picture to the last bit where light comes
// straight from the lamp, and the same light where it bounces.
TEST(Goniometric, AUniformOneIsAPointLight) {
  const auto scene = [](bool isPoint) {
    SceneBuilder b = floorSeenAt(Vec3(0.5f, 0, 0));
    b.box(b.material(testing::matte(Vec3(0.5f))), Vec3(-0.2f, 0.1f, -0.2f), Vec3(0.2f, 0.3f, 0.2f),
          false);
    const PunctualLight light = lampAt(Vec3(0.3f, 1, 0.2f), 3);
    if (isPoint) return b.light(light).build();
    return b.goniometric(light, {0, 70, 180}, {0, 10, 360}, [](float, float) { return 1.0f; })
        .build();
  };
  const Scene point = scene(true), measured = scene(false);
  const Tracer ofPoint(point, Isa::automatic), ofMeasured(measured, Isa::automatic);
  for (const auto& e : testing::estimators(8, 1)) {
    const auto one = testing::render(ofPoint, e.settings, 2).pixels;
    const auto other = testing::render(ofMeasured, e.settings, 2).pixels;
    ASSERT_EQ(one.size(), other.size());
    for (size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i], other[i]) << e.name;
  }
}

// Bright to one side and up, dark below; an object that focuses its light.
SceneBuilder room(bool withGlass) {
  SceneBuilder b;
  b.box(b.material(testing::matte(Vec3(0.6f, 0.5f, 0.4f))), Vec3(-1), Vec3(1), true);
  if (withGlass) b.sphere(b.material(testing::glass(1.5f)), Vec3(0.4f, -0.5f, 0), 0.3f, 24);
  PunctualLight light = lampAt(Vec3(-0.2f, 0.3f, 0.1f), 5);
  light.direction = glm::normalize(Vec3(0.3f, -1, 0.2f));
  b.goniometric(light, {0, 20, 60, 90, 130, 180}, {0, 40, 90, 180, 300, 360},
                [](float theta, float phi) {
                  const float side = phi == 40 || phi == 90 ? 1.0f : 0.2f;
                  return theta == 60 || theta == 130 ? side : theta == 20 ? 0.0f : 0.3f * side;
                });
  b.camera(Vec3(0.9f, 0.2f, 0.9f), Vec3(-0.3f, -0.5f, -0.4f), 1.2f);
  return b;
}

void expectAgreement(const Scene& scene, const std::vector<testing::Estimator>& all, int frames,
                     const testing::Tolerance& t) {
  const Tracer tracer(scene, Isa::automatic);
  const auto truth = testing::render(tracer, testing::reference().settings, frames);
  ASSERT_LT(truth.error(), 0.01 * truth.grey());
  testing::Tolerance allowed = t;
  allowed.bias += 5 * truth.error() / truth.grey();
  testing::expectRadiance(scene, all, truth.grey(), allowed);
}

TEST(Goniometric, AllMethodsAgreeInARoom) {
  expectAgreement(room(false).build(), testing::othersThanReference(), 1024,
                  {.frames = 64, .bias = 2e-3, .blur = 0.02});
}

// Caustics of punctual lights are found by photons alone: instant radiosity, with light aimed at
// the sphere, against the methods that have photons of their own.
TEST(Goniometric, MethodsWithPhotonsAgreeBehindGlass) {
  const Scene scene = room(true).build();
  const Tracer tracer(scene, Isa::automatic);
  const auto all = testing::othersThanReference();
  const auto truth = testing::render(tracer, all.front().settings, 200);
  testing::Tolerance t{.frames = 100, .bias = 0.01, .error = 0.02, .blur = 0.03};
  t.bias += 5 * truth.error() / truth.grey();
  testing::expectRadiance(scene, all, truth.grey(), t);
}

// Directions of ordinary particles by chi-square against I/(I Omega); the flux of aimed ones, cell
// by cell, against I: both through the world's axes.
TEST(Goniometric, ParticlesFollowTheTable) {
  const Scene scene = room(true).build();
  const Tracer tracer(scene, Isa::automatic);
  const Transport t(tracer, Settings{});
  constexpr int kRings = 12, kSectors = 12, kParts = 32;
  constexpr uint32_t kSamples = 1 << 17;
  const auto cellOf = [](Vec3 w) {
    const double phi = std::atan2(double(w.y), double(w.x)) / (2 * kExactPi);
    const int ring = std::min(static_cast<int>((1 - double(w.z)) / 2 * kRings), kRings - 1);
    const int sector =
        std::min(static_cast<int>((phi < 0 ? phi + 1 : phi) * kSectors), kSectors - 1);
    return static_cast<size_t>(ring * kSectors + sector);
  };
  std::vector<double> flux(kRings * kSectors, 0), seen = flux, aimed = flux, aimedSquares = flux;
  double whole = 0;
  for (int i = 0; i < kRings * kParts; ++i)
    for (int j = 0; j < kSectors * kParts; ++j) {
      const double z = 1 - 2 * (i + 0.5) / (kRings * kParts);
      const double phi = 2 * kExactPi * (j + 0.5) / (kSectors * kParts), r = std::sqrt(1 - z * z);
      const Vec3 w(DVec3(r * std::cos(phi), r * std::sin(phi), z));
      const double share = 4 * kExactPi / (kRings * kSectors * kParts * kParts);
      const double add = share * double(Emitters::intensity(scene, scene.lights[0], w).x);
      flux[static_cast<size_t>(i / kParts * kSectors + j / kParts)] += add, whole += add;
    }
  EXPECT_NEAR(whole, double(t.emitters[0].flux.x), 2e-3 * whole);
  const LightSampler sampler(1, SampleUse::photon, 0, 0, 17, Randomization::owen);
  for (uint32_t i = 0; i < kSamples; ++i) {
    const Particle p = emitParticle(t, 0, sampler.get2D(i, 0), sampler.get2D(i, 2));
    EXPECT_EQ(p.flux, t.emitters[0].flux);
    seen[cellOf(p.direction)] += 1;
    const Particle q =
        emitAimed(t, 0, sampler.get2D(i, 0), sampler.get2D(i, 2), sampler.get1D(i, 4));
    aimed[cellOf(q.direction)] += double(q.flux.x) / kSamples;
    aimedSquares[cellOf(q.direction)] += double(q.flux.x) * double(q.flux.x) / kSamples;
  }
  std::vector<double> expected;
  for (size_t i = 0; i < flux.size(); ++i) {
    expected.push_back(kSamples * flux[i] / whole);
    const double error = std::sqrt(aimedSquares[i] / kSamples);  // not less: the set is stratified
    EXPECT_NEAR(aimed[i], flux[i], 5 * error + 5e-3 * flux[i]) << i;
  }
  EXPECT_GT(chiSquareP(seen, expected), 1e-3);
}

}  // namespace
}  // namespace ninefold
