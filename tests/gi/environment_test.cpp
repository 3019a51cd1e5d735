// Light from outside by a picture, by every method: against the constant that it equals, a
// directional light, and the reference path tracer.
#include "common/gi/light/direct_light.h"
#include "common/gi/light/emission.h"
#include "common/sampling/sampler.h"
#include "common/scene/sky_model.h"
#include "tests/gi/expect.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

constexpr double kExactPi = 3.14159265358979323846;

template <typename Value>
std::shared_ptr<const EnvironmentMap> mapOf(int height, Value value, float rotation = 0) {
  EnvironmentPicture p{"--environment FILE", 2 * height, height, {}, rotation};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < p.width; ++x) p.texels.push_back(value(x, y));
  return std::make_shared<const EnvironmentMap>(std::move(p));
}

// A sun on few texels, a million times as bright as the rest, 27 degrees above the horizon.
std::shared_ptr<const EnvironmentMap> sunAndSky() {
  return mapOf(64, [](int x, int y) {
    return x == 40 && y == 22 ? Vec3(4e4f, 3e4f, 2e4f) : y < 32 ? Vec3(0.04f) : Vec3(0.01f);
  });
}

SceneBuilder openBox(const Material& thing) {
  SceneBuilder b;
  b.quad(b.material(testing::matte(Vec3(0.5f))), Vec3(-2, 0, 2), Vec3(4, 0, 0), Vec3(0, 0, -4));
  b.box(b.material(thing), Vec3(-0.5f, 0.01f, -0.5f), Vec3(0.5f, 1, 0.5f), false);
  b.camera(Vec3(0, 1.5f, 3), Vec3(0, 0.3f, 0), 0.9f);
  return b;
}

// The same flux, density and radiance as the constant of its colour, to a millionth.
TEST(Environment, AUniformPictureHasTheEnergyOfItsColour) {
  const Radiance colour(0.7f, 2, 0.1f);
  Scene plain = openBox(testing::matte(Vec3(0.7f))).environment(3.0f * colour).build();
  Scene mapped = plain;
  mapped.environment = Radiance(3),
  mapped.environmentMap = mapOf(16, [&](int, int) { return colour; });
  const Emitters one(plain, plain.environment), other(mapped, mapped.environment);
  ASSERT_EQ(one.size(), other.size());
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(other[0].flux[c] / one[0].flux[c], 1, 1e-6);
  for (int i = 0; i < 500; ++i) {
    const Vec3 w = other.sampleEnvironment(Vec2(i % 25, i / 25) / 25.0f);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(other.environment(w)[c] / one.environment(w)[c], 1, 1e-6);
    EXPECT_NEAR(other.environmentPdf(w) / one.environmentPdf(w), 1, 1e-6);
  }
}

// A convex thing of albedo a before a uniform picture of 1 shows a, by every method.
TEST(Environment, AUniformPictureIsAFurnace) {
  SceneBuilder b;
  b.sphere(b.material(testing::matte(Vec3(0.6f))), Vec3(0), 1, 48);
  b.camera(Vec3(0, 0, 3), Vec3(0), 0.2f);
  Scene scene = b.environment(Radiance(1)).build();
  scene.environmentMap = mapOf(16, [](int, int) { return Vec3(1); });
  testing::expectRadiance(scene, testing::estimators(8), 0.6,
                          {.frames = 64, .bias = 5e-3, .error = 0.02, .blur = 0.05});
}

// A disk of radiance L and half angle a, seen from a floor at height h: E = pi sin^2 a L sin h, as
// a directional light of E0 = pi sin^2 a L sends. Its texels are small beside the disk.
TEST(Environment, ASunDiskIsADirectionalLight) {
  constexpr double kHalfAngle = 0.02, kUp = 0.9, kRadiance = 1000;
  const DVec3 sun(std::cos(kUp), std::sin(kUp), 0);
  constexpr int kHeight = 1024;
  double solidAngle = 0;
  const auto map = mapOf(kHeight, [&](int x, int y) {
    const double theta = kExactPi * (y + 0.5) / kHeight;
    const double phi = kExactPi * ((x + 0.5) / kHeight - 1);
    const DVec3 w(std::sin(theta) * std::cos(phi), std::cos(theta),
                  std::sin(theta) * std::sin(phi));
    if (glm::dot(w, sun) < std::cos(kHalfAngle)) return Vec3(0);
    solidAngle += 2 * kExactPi * kExactPi / (2.0 * kHeight * kHeight) * std::sin(theta);
    return Vec3(float(kRadiance));
  });
  EXPECT_NEAR(solidAngle, kExactPi * kHalfAngle * kHalfAngle, 0.01 * solidAngle);
  SceneBuilder b;
  b.quad(b.material(testing::matte(Vec3(0.5f))), Vec3(-3, 0, 3), Vec3(6, 0, 0), Vec3(0, 0, -6));
  b.camera(Vec3(0.1f, 0.2f, 0.3f), Vec3(0), 1e-3f);
  Scene scene = b.environment(Radiance(1)).build();
  scene.environmentMap = map;
  const double expected = 0.5 / kExactPi * kRadiance * solidAngle * std::sin(kUp);
  testing::expectRadiance(scene, testing::estimators(8, 1), expected,
                          {.frames = 16, .bias = 4e-3, .error = 0.01});
}

// Particles carry the picture's power, in the ordinary way and aimed at glass.
TEST(Environment, MeanFluxIsThePicturesPower) {
  SceneBuilder b = openBox(testing::glass(1.5f));
  Scene scene = b.environment(Radiance(2)).build();
  scene.environmentMap = sunAndSky();
  const Tracer tracer(scene, Isa::automatic);
  Settings settings;
  settings.environment = scene.environment;
  const Transport t(tracer, settings);
  ASSERT_FALSE(t.targets.empty());
  const double R = 1.0001 * double(scene.bounds.radius());
  const double whole = 4 * kExactPi * kExactPi * R * R * 2 * double(scene.environmentMap->mean().x);
  const double bound = 3 / (1 - kAlike) / double(kOrdinaryShare);
  for (const bool aimed : {false, true}) {
    double sum = 0;
    constexpr uint32_t kCount = 1 << 16;
    const LightSampler sampler(1, SampleUse::photon, 0, 0, 16, Randomization::owen);
    for (uint32_t i = 0; i < kCount; ++i) {
      const Particle p =
          aimed ? emitAimed(t, 0, sampler.get2D(i, 0), sampler.get2D(i, 2), sampler.get1D(i, 4))
                : emitParticle(t, 0, sampler.get2D(i, 0), sampler.get2D(i, 2));
      ASSERT_LE(p.flux.x, bound * whole) << "no particle is too bright";
      sum += double{p.flux.x} / kCount;
    }
    EXPECT_NEAR(sum / whole, 1, 0.02) << aimed;
  }
}

// Direct light at a point does not sparkle: a sample of the sun or of the sky carries a few times
// the mean at most, whichever technique finds it.
TEST(Environment, NoSampleOfLightIsMuchBrighterThanTheMean) {
  Scene scene = openBox(testing::matte(Vec3(0.7f))).environment(Radiance(1)).build();
  scene.environmentMap = sunAndSky();
  const Tracer tracer(scene, Isa::automatic);
  Settings settings;
  settings.environment = scene.environment;
  const Transport t(tracer, settings);
  const double whole = 4 * kExactPi * double(scene.environmentMap->mean().x);
  ShadingPoint p{};
  p.surface.position = Vec3(0, 1, 0), p.surface.geometricNormal = p.ng = p.ns = Vec3(0, 1, 0);
  for (int i = 0; i < 4096; ++i) {
    const auto light = sampleLight(t, 0, p, Vec2(i % 64, i / 64) / 64.0f);
    ASSERT_TRUE(light);
    EXPECT_LE(double{light->weight.x}, 3 / (1 - kAlike) * 1.01 * whole);
    EXPECT_NEAR(light->pdf, environmentPdf(t, light->w), 1e-5f * light->pdf);
  }
}

void expectAgreement(Scene scene, const std::shared_ptr<const EnvironmentMap>& map, int frames,
                     double bias) {
  scene.environmentMap = map;
  const Tracer tracer(scene, Isa::automatic);
  const auto truth = testing::render(tracer, testing::reference(12).settings, 4 * frames);
  for (testing::Estimator& e : testing::othersThanReference(12)) {
    e.settings.directVpls = 8, e.settings.indirectVpls = 48;
    if (!e.facts().has(kReverseVpls)) e.settings.bound = 3000;
    const auto image = testing::render(tracer, e.settings, frames);
    const double error = std::hypot(image.error(), truth.error());
    EXPECT_NEAR(image.grey(), truth.grey(), 4 * error + bias * truth.grey())
        << e.name << ": " << image.grey() << " +- " << image.error() << ", reference "
        << truth.grey() << " +- " << truth.error();
    EXPECT_LT(error, 0.03 * truth.grey()) << e.name;
  }
}

TEST(Environment, AllMethodsAgreeUnderASunAMillionTimesAsBrightAsItsSky) {
  expectAgreement(openBox(testing::matte(Vec3(0.7f, 0.4f, 0.2f))).environment(Radiance(1)).build(),
                  sunAndSky(), 24, 0.015);
}

TEST(Environment, AllMethodsAgreeThroughGlass) {
  SceneBuilder b;
  b.quad(b.material(testing::matte(Vec3(0.5f))), Vec3(-2, 0, 2), Vec3(4, 0, 0), Vec3(0, 0, -4));
  b.sphere(b.material(testing::glass(1.5f)), Vec3(0, 0.6f, 0), 0.5f, 32);
  b.camera(Vec3(0, 1.5f, 3), Vec3(0, 0.3f, 0), 0.7f).environment(Radiance(1));
  const auto soft = mapOf(16, [](int x, int y) {
    return x > 18 && x < 24 && y > 2 && y < 7 ? Vec3(8, 7, 5) : Vec3(0.3f, 0.4f, 0.6f);
  });
  expectAgreement(b.build(), soft, 48, 0.02);
}

TEST(Environment, AllMethodsAgreeUnderAClearSkyOnARoughMetal) {
  Material metal = testing::mirror(Vec3(0.9f, 0.7f, 0.4f));
  metal.roughness = 0.3f;
  expectAgreement(
      openBox(metal).environment(Radiance(0.01f)).build(),
      std::make_shared<const EnvironmentMap>(skyPicture({.azimuth = 120, .elevation = 35})), 48,
      0.02);
}

// Where nothing is met the picture is seen as it is.
TEST(Environment, TheBackgroundIsThePicture) {
  SceneBuilder b;
  b.sphere(b.material(testing::matte(Vec3(0))), Vec3(0), 0.1f, 8);
  b.camera(Vec3(0, 0, 3), Vec3(3, 0, 3), 1e-3f).environment(Radiance(2));  // looks along +x
  Scene scene = b.build();
  scene.environmentMap =
      mapOf(8, [](int x, int y) { return Vec3(static_cast<float>(x), static_cast<float>(y), 1); });
  const Tracer tracer(scene, Isa::automatic);
  for (const testing::Estimator& e : testing::estimators(4)) {
    const Vec3 mean = testing::render(tracer, e.settings, 1).mean();
    EXPECT_NEAR(mean.x, 15, 0.02f) << e.name;
    EXPECT_NEAR(mean.y, 7, 0.02f) << e.name;
    EXPECT_NEAR(mean.z, 2, 1e-5f) << e.name;
  }
}

}  // namespace
}  // namespace ninefold
