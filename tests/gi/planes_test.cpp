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
  const auto state = wholeState(renderer, s, frame);
  TileResult tile;
  for (int phase = 0; phase < s.interleave.sets(); ++phase) {
    renderer.render({key, 0, phase, planes, {}}, *renderer.light(key, phase, state.get()), *scratch,
                    tile);
    visit(phase, tile);
  }
}

TEST(Planes, OfTheFirstHitAreTheSameBitsByEveryMethod) {
  const Scene scene = room();
  const Tracer tracer(scene, Isa::automatic);
  std::vector<ExtraPlanes> first;
  for (const MethodFacts& facts : allMethods()) {
    Settings s = testing::small(facts.method, kSide);
    s.jitter = false;  // methods with several paths a pixel have film positions of their own
    const uint8_t planes = kAlbedoPlane | kNormalPlane | kDepthPlane | kObjectPlane;
    std::vector<ExtraPlanes> seen;
    forEachTask(tracer, s, 0, planes,
                [&](int, const TileResult& tile) { seen.push_back(tile.extras); });
    if (first.empty()) first = seen;
    EXPECT_EQ(seen, first) << facts.name;
  }
  const ExtraPlanes& task = first.front();
  for (size_t i = 0; i < task.depth.size(); ++i) {
    EXPECT_GT(task.depth[i], 0);
    EXPECT_GT(task.object[i], 0u);
    EXPECT_GT(task.albedo.r[i], 0);
    EXPECT_NEAR(glm::length(testing::pixelAt(task.normal, i)), 1, 1e-5f);
  }
}

struct Incident {
  double irradiance = 0, caustic = 0;  // means over the picture
};

Incident meanIncident(const Tracer& tracer, const Settings& s, uint32_t frame) {
  const bool isWhole = factsOf(s.method).isUnfiltered;  // then no layer has E
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

struct Incidents {
  Estimate irradiance, caustic;
};

Incidents incidents(const Tracer& tracer, const testing::Estimator& e) {
  std::vector<double> irradiance, caustic;
  const auto frames = static_cast<uint32_t>(e.frames(48, 400));
  for (uint32_t frame = 0; frame < frames; ++frame) {
    const Incident mean = meanIncident(tracer, e.settings, frame);
    irradiance.push_back(mean.irradiance), caustic.push_back(mean.caustic);
  }
  return {over(irradiance), over(caustic)};
}

// All estimate E at the first hit, and what of it came through the ball. Tolerance: five standard
// errors, and 2 % of what photons blur.
TEST(Planes, IrradianceAndItsCausticPartAreOneQuantityByEveryMethod) {
  const Scene scene = room();
  const Tracer tracer(scene, Isa::automatic);
  const Incidents reference = incidents(tracer, testing::reference(kSide));
  EXPECT_GT(reference.caustic.mean, 0.01 * reference.irradiance.mean);
  const auto expectSame = [](const Estimate& a, const Estimate& b, double bias,
                             const std::string& what) {
    EXPECT_NEAR(a.mean, b.mean, 5 * std::hypot(a.error, b.error) + bias * b.mean)
        << what << " +- " << a.error << ", " << b.error;
    for (const Estimate& e : {a, b}) EXPECT_LT(e.error, 0.05 * e.mean) << what;
  };
  for (const testing::Estimator& e : testing::othersThanReference(kSide)) {
    const Incidents other = incidents(tracer, e);
    expectSame(other.irradiance, reference.irradiance, 0.002, "irradiance by " + e.name);
    expectSame(other.caustic, reference.caustic, 0.02, "caustic by " + e.name);
  }
}

// Light straight from the lamp, and all other light, are the picture: also where it comes by way of
// S.
void expectSum(const Tracer& tracer, const testing::Estimator& e) {
  const Settings& all = e.settings;
  Settings direct = all, indirect = all;
  direct.pathLength = 1, direct.caustics = Caustics::off;
  indirect.directVpls = 0;
  // What the eye sees of the lamp itself, by glass, is in both.
  Settings dark = direct;
  dark.directVpls = 0;
  const auto of = [&](const Settings& s) { return testing::render(tracer, s, e.frames(96, 300)); };
  const auto whole = of(all), a = of(direct), b = of(indirect), lamp = of(dark);
  const double error =
      std::sqrt(whole.error() * whole.error() + a.error() * a.error() + b.error() * b.error());
  EXPECT_NEAR(a.grey() + b.grey() - lamp.grey(), whole.grey(), 5 * error) << e.name;
  EXPECT_LT(error, 0.02 * whole.grey()) << e.name;
  EXPECT_GT(b.grey(), 0.2 * whole.grey()) << e.name;
}

TEST(Planes, DirectAndIndirectLightAddUp) {
  const Scene scene = room();
  const Tracer tracer(scene, Isa::automatic);
  for (const testing::Estimator& e : testing::estimators(kSide)) expectSum(tracer, e);
}

// What --caustics leaves out, it leaves out of every method.
TEST(Planes, CausticsAreCutAlikeByEveryMethod) {
  const Scene scene = room();
  const Tracer tracer(scene, Isa::automatic);
  for (const Caustics caustics : {Caustics::off, Caustics::direct}) {
    const auto image = [&](testing::Estimator e) {
      e.settings.caustics = caustics;
      const auto rendered = testing::render(tracer, e.settings, e.frames(48, 300));
      EXPECT_LT(rendered.error(), 0.02 * rendered.grey()) << e.name;
      return rendered;
    };
    const auto reference = image(testing::reference(kSide));
    for (const testing::Estimator& e : testing::othersThanReference(kSide)) {
      const auto other = image(e);
      EXPECT_NEAR(other.grey(), reference.grey(),
                  5 * std::hypot(other.error(), reference.error()) + 0.002 * reference.grey())
          << e.name << ", " << static_cast<int>(caustics);
    }
  }
}

}  // namespace
}  // namespace ninefold
