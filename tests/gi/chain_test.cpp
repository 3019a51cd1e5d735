// Specular chains up to their limit. A corridor between two mirrors, z = 0 and z = 1, and x from 0
// to n: what runs along (1, 0, 1)/sqrt(2) meets them n times, at 45 degrees, before the wall at x =
// n, and each time keeps Schlick's F = f0 + (1 - f0)(1 - cos 45)^5. It arrives if and only if
// specular-depth >= n.
#include "tests/gi/expect.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::number;
using testing::SceneBuilder;

double schlick(float f0) {
  return static_cast<double>(f0) + (1 - static_cast<double>(f0)) * std::pow(1 - std::sqrt(0.5), 5);
}

SceneBuilder corridor(int n, float f0, const Material& wall) {
  const float length = static_cast<float>(n);
  SceneBuilder b;
  const int silver = b.material(testing::mirror(Vec3(f0)));
  b.quad(silver, Vec3(0, -1, 0), Vec3(length, 0, 0), Vec3(0, 2, 0));
  b.quad(silver, Vec3(0, -1, 1), Vec3(0, 2, 0), Vec3(length, 0, 0));
  b.quad(b.material(wall), Vec3(length, -1, 0), Vec3(0, 0, 1), Vec3(0, 2, 0));
  return b;
}

void expectBlack(const Tracer& tracer, const testing::Estimator& e, int frames) {
  for (const Vec3& p : testing::render(tracer, e.settings, frames).pixels)
    EXPECT_EQ(p, Vec3(0)) << e.name << ", depth " << e.settings.specularDepth;
}

// An eye at (0, 0, 1/2) looks down the corridor at a wall that emits 1: L = F^n, or nothing.
TEST(Chain, EyesSeeThroughAsManyMirrorsAsTheLimitSays) {
  struct Case {
    int n;
    float f0;
  };
  for (const Case& c : {Case{1, 0.8f}, {2, 0.8f}, {5, 0.8f}, {32, 1.0f}, {128, 1.0f}}) {
    SceneBuilder b = corridor(c.n, c.f0, testing::matte(Vec3(0), Vec3(1)));
    b.camera(Vec3(0, 0, 0.5f), Vec3(1, 0, 1.5f), 1e-3f);
    const Scene scene = b.build();
    const Tracer tracer(scene, Isa::automatic);
    for (auto& e : testing::estimators()) {
      e.settings.specularDepth = c.n;
      testing::expectMean(testing::render(tracer, e.settings, 16), std::pow(schlick(c.f0), c.n),
                          {.error = 0.05}, e.name + ", chain of " + number(c.n));
      if (c.n == 1) continue;  // the least limit is 1
      e.settings.specularDepth = c.n - 1;
      expectBlack(tracer, e, 2);
    }
  }
}

// The longest chain that may be asked for, of perfect mirrors, by the eye paths that methods share.
// Not for the path tracer: its roulette lets 0.99^1024, one path in 30,000, come so far.
TEST(Chain, EyePathsAreFollowedThroughAThousandMirrors) {
  const int n = 1024;
  SceneBuilder b = corridor(n, 1, testing::matte(Vec3(0), Vec3(1)));
  b.camera(Vec3(0, 0, 0.5f), Vec3(1, 0, 1.5f), 1e-5f);
  const Scene scene = b.build();
  const Tracer tracer(scene, Isa::automatic);
  testing::Estimator e = testing::radiosity();
  e.settings.specularDepth = n;
  testing::expectMean(testing::render(tracer, e.settings, 2), 1, {}, e.name);
  e.settings.specularDepth = n - 1;
  expectBlack(tracer, e, 2);
}

// The sun, E0 across itself, shines in at x = 0 and ends on a white wall (albedo a):
// L = a/pi E0 cos 45 F^n. Photons bring it; methods without them cannot find it, as they say.
TEST(Chain, PhotonsPassAsManyMirrorsAsTheLimitSays) {
  PunctualLight sun;
  sun.kind = LightKind::directional, sun.intensity = Vec3(2);
  sun.direction = glm::normalize(Vec3(1, 0, 1));
  const float f0 = 0.8f;
  for (const int n : {1, 2, 3}) {
    SceneBuilder b = corridor(n, f0, testing::matte(Vec3(0.5f)));
    const float x = static_cast<float>(n);
    b.light(sun).camera(Vec3(x - 0.3f, 0, 0.5f), Vec3(x, 0, 0.5f), 0.1f);
    const Scene scene = b.build();
    const Tracer tracer(scene, Isa::automatic);
    const double expected =
        0.5 / static_cast<double>(kPi) * 2 * std::sqrt(0.5) * std::pow(schlick(f0), n);
    for (auto& e : testing::estimators(8, 1)) {
      e.settings.photonRadius = 0.05f, e.settings.specularDepth = n;
      if (e.facts().missesPunctualCaustics) {
        expectBlack(tracer, e, 2);
        continue;
      }
      testing::expectMean(testing::render(tracer, e.settings, 64), expected, {.error = 0.05},
                          e.name + ", chain of " + number(n));
      e.settings.specularDepth = n - 1;
      if (n > 1) expectBlack(tracer, e, 4);
    }
  }
}

}  // namespace
}  // namespace ninefold
