// A million photons in one set: as right as a thousand, and found as brute force finds them.
#include <random>

#include "common/gi/photons/photon_grid.h"
#include "tests/gi/expect.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

// A glass ball in a furnace of albedo 1/2 and emission 1 changes nothing: L = 2. One set, of which
// the photons are all that comes through the ball; their noise is then small beside that of the
// VPLs.
TEST(MillionPhotons, KeepTheFurnace) {
  SceneBuilder b;
  b.box(b.material(testing::matte(Vec3(0.5f), Vec3(1))), Vec3(-1), Vec3(1), true);
  b.sphere(b.material(testing::glass(1.5f)), Vec3(0, -0.3f, 0), 0.4f, 64);
  b.camera(Vec3(0, 0.1f, 0.95f), Vec3(0.05f, -0.3f, -0.3f), 1.0f);
  const Scene scene = b.build();
  const Tracer tracer(scene, Isa::automatic);
  Settings s = testing::estimators(16)[1].settings;
  s.interleave = {1, 1}, s.photons = 1 << 20, s.photonRadius = 2e-3f;
  s.directVpls = 256, s.indirectVpls = 1024;
  testing::expectMean(testing::render(tracer, s, 8), 2, {.bias = 2e-3, .error = 0.02}, "");
}

TEST(MillionPhotons, AreFoundAsByBruteForce) {
  constexpr size_t kCount = 1 << 20;
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(-1, 1);
  std::vector<Photon> photons(kCount);
  for (Photon& p : photons)
    p.position = Vec3(uniform(random), uniform(random), 1e-3f * uniform(random));
  for (const float radius : {1e-4f, 0.01f, 0.5f}) {
    const PhotonGrid grid(photons, radius);
    for (int query = 0; query < 20; ++query) {
      const Vec3 x(uniform(random), uniform(random), 0);
      size_t found = 0, expected = 0;
      grid.near(x, x, [&](const Photon&) { ++found; });
      for (const Photon& p : photons)
        expected += glm::dot(p.position - x, p.position - x) <= radius * radius ? 1 : 0;
      EXPECT_EQ(found, expected) << radius;
    }
  }
}

}  // namespace
}  // namespace ninefold
