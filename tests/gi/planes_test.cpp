// The extra planes are the same whatever the method: what the eye sees does not depend on how light
// is found, and E at the first hit is one quantity.
#include <gtest/gtest.h>

#include "tests/gi/expect.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

constexpr int kSide = 12;

// A white ball of glass over the floor of a room with a lamp, a metal wall, and an open front.
Scene room() {
  SceneBuilder b;
  const int grey = b.material(testing::matte(Vec3(0.6f, 0.5f, 0.4f)));
  b.box(grey, Vec3(-1), Vec3(1), true);
  b.quad(b.material(testing::matte(Vec3(0), Vec3(12))), Vec3(-0.4f, 0.98f, -0.4f), Vec3(0.8f, 0, 0),
         Vec3(0, 0, 0.8f));
  b.sphere(b.material(testing::glass(1.5f)), Vec3(0, -0.5f, 0), 0.35f, 24);
  b.camera(Vec3(0, 0.1f, 0.95f), Vec3(0.05f, -0.6f, -0.3f), 1.2f);
  return b.build();
}

// All of a frame's tasks, unfiltered.
template <typename Visit>
void forEachTask(const Tracer& tracer, Settings s, uint32_t frame, uint8_t planes,
                 const Visit& visit) {
  s.camera = tracer.scene().cameras.front();
  const Renderer renderer(tracer, s);
  const auto scratch = renderer.makeScratch();
  const FrameKey key{frame, frame, 0, s.photonRadius * tracer.scene().bounds.radius()};
  TileResult tile;
  for (int phase = 0; phase < s.interleave.sets(); ++phase) {
    renderer.render({key, 0, phase, planes, {}}, *renderer.light(key, phase), *scratch, tile);
    visit(phase, tile);
  }
}

TEST(Planes, OfTheFirstHitAreTheSameBitsByEveryMethod) {
  const Scene scene = room();
  const Tracer tracer(scene, Isa::automatic);
  std::vector<ExtraPlanes> seen[2];
  for (const Method method : {Method::instantRadiosity, Method::pathTrace}) {
    Settings s = testing::small(method, kSide);
    s.jitter = false;  // methods with several paths a pixel have film positions of their own
    const uint8_t planes = kAlbedoPlane | kNormalPlane | kDepthPlane | kObjectPlane;
    forEachTask(tracer, s, 0, planes, [&](int, const TileResult& tile) {
      seen[static_cast<size_t>(method)].push_back(tile.extras);
    });
  }
  EXPECT_EQ(seen[0], seen[1]);
  const ExtraPlanes& first = seen[1].front();
  for (size_t i = 0; i < first.depth.size(); ++i) {
    EXPECT_GT(first.depth[i], 0);
    EXPECT_GT(first.object[i], 0u);
    EXPECT_GT(first.albedo.r[i], 0);
    EXPECT_NEAR(glm::length(testing::pixelAt(first.normal, i)), 1, 1e-5f);
  }
}

struct Incident {
  double irradiance = 0, caustic = 0;  // means over the picture
};

Incident meanIncident(const Tracer& tracer, const Settings& s, uint32_t frame) {
  const bool isWhole = s.method == Method::pathTrace;
  const uint8_t planes = kCausticPlane | (isWhole ? kIrradiancePlane : 0);
  Incident mean;
  forEachTask(tracer, s, frame, planes, [&](int, const TileResult& tile) {
    const RgbPlane& e = isWhole ? tile.extras.irradiance : tile.layers[kDiffuse].irradiance;
    for (size_t i = 0; i < e.g.size(); ++i) {
      mean.irradiance += static_cast<double>(e.g[i]) / (kSide * kSide);
      mean.caustic += static_cast<double>(tile.extras.caustic.g[i]) / (kSide * kSide);
    }
  });
  return mean;
}

struct Estimate {
  double mean, error;
};

Estimate over(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  double sum = 0, squares = 0;
  for (const double v : values) sum += v;
  for (const double v : values) squares += (v - sum / n) * (v - sum / n);
  return {sum / n, std::sqrt(squares / (n * (n - 1)))};
}

// Both estimate E at the first hit, and what of it came through the ball. Tolerance: five standard
// errors, and 2 % of what photons blur.
TEST(Planes, IrradianceAndItsCausticPartAreOneQuantityByEveryMethod) {
  const Scene scene = room();
  const Tracer tracer(scene, Isa::automatic);
  Estimate irradiance[2], caustic[2];
  for (const testing::Estimator& e : testing::estimators(kSide)) {
    const bool isWhole = e.settings.method == Method::pathTrace;
    std::vector<double> es, cs;
    for (uint32_t frame = 0; frame < (isWhole ? 400u : 48u); ++frame) {
      const Incident mean = meanIncident(tracer, e.settings, frame);
      es.push_back(mean.irradiance), cs.push_back(mean.caustic);
    }
    irradiance[isWhole] = over(es), caustic[isWhole] = over(cs);
  }
  const auto expectSame = [](const Estimate(&e)[2], double bias, const char* what) {
    EXPECT_NEAR(e[0].mean, e[1].mean, 5 * std::hypot(e[0].error, e[1].error) + bias * e[1].mean)
        << what << " +- " << e[0].error << ", " << e[1].error;
    EXPECT_LT(e[1].error, 0.05 * e[1].mean) << what;
  };
  expectSame(irradiance, 0.002, "irradiance");
  expectSame(caustic, 0.02, "caustic");
  EXPECT_GT(caustic[1].mean, 0.01 * irradiance[1].mean);
}

// Light straight from the lamp, and all other light, are the picture: also where it comes by way of
// S.
TEST(Planes, DirectAndIndirectLightAddUpByThePathTracer) {
  const Scene scene = room();
  const Tracer tracer(scene, Isa::automatic);
  Settings all = testing::small(Method::pathTrace, kSide), direct = all, indirect = all;
  direct.pathLength = 1, direct.caustics = Caustics::off;
  indirect.directVpls = 0;
  // What the eye sees of the lamp itself, by glass, is in both.
  Settings dark = direct;
  dark.directVpls = 0;
  const auto of = [&](const Settings& s) { return testing::render(tracer, s, 300); };
  const auto whole = of(all), a = of(direct), b = of(indirect), lamp = of(dark);
  const double error =
      std::sqrt(whole.error() * whole.error() + a.error() * a.error() + b.error() * b.error());
  EXPECT_NEAR(a.grey() + b.grey() - lamp.grey(), whole.grey(), 5 * error);
  EXPECT_LT(error, 0.02 * whole.grey());
  EXPECT_GT(b.grey(), 0.2 * whole.grey());
}

// What --caustics leaves out, it leaves out of both methods.
TEST(Planes, CausticsAreCutAlikeByEveryMethod) {
  const Scene scene = room();
  const Tracer tracer(scene, Isa::automatic);
  for (const Caustics caustics : {Caustics::off, Caustics::direct}) {
    std::vector<testing::Rendered> images;
    for (testing::Estimator e : testing::estimators(kSide)) {
      e.settings.caustics = caustics;
      images.push_back(
          testing::render(tracer, e.settings, e.settings.method == Method::pathTrace ? 300 : 48));
    }
    EXPECT_NEAR(images[0].grey(), images[1].grey(),
                5 * std::hypot(images[0].error(), images[1].error()) + 0.002 * images[0].grey())
        << static_cast<int>(caustics);
    EXPECT_LT(images[0].error(), 0.02 * images[0].grey());
  }
}

}  // namespace
}  // namespace ninefold
