// Photons where they are hardest to count: none, a radius that shrinks to nothing, and a query in
// the middle of a cell. (One photon: energy_balance_test. A million: tests/nightly.)
#include <random>

#include "common/gi/photons/photon_grid.h"
#include "tests/gi/expect.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

// A query of radius r around the very middle of a cell of side 2r reaches both of its sides, and
// with rounding a little more: whatever cells that makes, it must find what brute force finds.
TEST(PhotonsHard, QueriesInTheMiddleOfACellFindAllThatIsNear) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> uniform(-2, 4);
  std::vector<Photon> photons(4000);
  for (Photon& p : photons) p.position = Vec3(uniform(random), uniform(random), uniform(random));
  const PhotonGrid grid(photons, 1);
  for (const float at : {0.9999f, 1.0f, 1.0001f, 1.0002f, 1.0003f, -1.0f, 3.0f}) {
    size_t found = 0, expected = 0;
    grid.near(Vec3(at), Vec3(at), [&](const Photon&) { ++found; });
    for (const Photon& p : photons)
      expected += glm::dot(p.position - Vec3(at), p.position - Vec3(at)) <= 1 ? 1 : 0;
    EXPECT_EQ(found, expected) << at;
    EXPECT_GT(found, 20u);
  }
}

// A furnace of albedo a = 1/2 and emission 1 with a glass ball: L = 2, of which photons carry what
// comes through the ball.
Scene furnaceWithBall() {
  SceneBuilder b;
  b.box(b.material(testing::matte(Vec3(0.5f), Vec3(1))), Vec3(-1), Vec3(1), true);
  b.sphere(b.material(testing::glass(1.5f)), Vec3(0, -0.3f, 0), 0.4f, 48);
  b.camera(Vec3(0, 0.1f, 0.95f), Vec3(0.05f, -0.3f, -0.3f), 1.0f);
  return b.build();
}

testing::Rendered withPhotons(int photons, float radius, int frames) {
  const Scene scene = furnaceWithBall();
  const Tracer tracer(scene, Isa::automatic);
  auto estimator = testing::radiosity();
  estimator.settings.photons = photons, estimator.settings.photonRadius = radius;
  return testing::render(tracer, estimator.settings, frames);
}

// Without photons their light is missing and nothing else: never more than the furnace's.
TEST(PhotonsHard, NoneAtAllLeavesTheLightThroughGlassOut) {
  const auto image = withPhotons(0, 0.01f, 64);
  EXPECT_LT(image.grey() + 5 * image.error(), 2);
  EXPECT_GT(image.grey(), 1.7);
}

// Radius towards zero: ever fewer photons count ever more, E stays finite; at the end none is met,
// and what remains is the picture without photons.
TEST(PhotonsHard, RadiusTowardsZeroStaysFinite) {
  const auto none = withPhotons(0, 0.01f, 16);
  for (const float radius : {1e-9f, 1e-19f, 1e-30f}) {
    const auto image = withPhotons(2000, radius, 16);
    for (size_t i = 0; i < image.pixels.size(); ++i)
      ASSERT_EQ(image.pixels[i], none.pixels[i]) << radius;
  }
}

}  // namespace
}  // namespace ninefold
