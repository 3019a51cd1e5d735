// Photons that meet a simpler scene than the one that is seen: they carry what the lamps send, and
// a picture is as it was where the simpler things lie near the finer ones.
#include <gtest/gtest.h>

#include "common/gi/photon_map/map_photon.h"
#include "common/scene/photon_scene.h"
#include "tests/gi/expect.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

// A room with a ball of so many rings, a point light and, if so, a lamp of some area.
Scene room(int rings, bool areaLamp, float lampRadiance = 3) {
  SceneBuilder b;
  b.box(b.material(testing::matte(Vec3(0.6f))), Vec3(-1), Vec3(1), true);
  if (areaLamp)
    b.quad(b.material(testing::matte(Vec3(0.5f), Vec3(lampRadiance))), Vec3(-0.25f, 0.9f, -0.2f),
           Vec3(0.5f, 0, 0), Vec3(0, 0, 0.4f));
  b.sphere(b.material(testing::matte(Vec3(0.7f, 0.4f, 0.2f))), Vec3(0.2f, -0.4f, -0.3f), 0.4f,
           rings);
  PunctualLight light;
  light.position = Vec3(-0.5f, 0.3f, 0.5f), light.intensity = Vec3(0.5f);
  b.light(light).camera(Vec3(0, 0, 0.95f), Vec3(0, -0.2f, -1), 1.2f);
  return b.build();
}

Scene with(Scene scene, const Scene& simple) {
  addPhotonScene(scene, simple);
  return scene;
}

Settings pool() {
  Settings s = testing::small(Method::photonMap, 16);
  s.mapPhotons = 2000, s.mapPerFrame = 500, s.mapDirect = MapDirect::on;
  return s;
}

std::vector<MapPhoton> photonsOf(const Scene& scene, const Settings& s) {
  const Tracer tracer(scene, Isa::automatic);
  return readPhotons(stateAtRest(Renderer(tracer, s), s, 0));
}

// A point light has no geometry, so that the same scene twice is the same to the last bit.
TEST(PhotonScene, OfTheSceneItselfIsTheScene) {
  const Scene scene = room(12, false);
  EXPECT_EQ(photonsOf(with(scene, scene), pool()), photonsOf(scene, pool()));
}

// In a closed room all of the lamps' flux arrives, 4 pi I + pi A L; of the simpler scene's nothing.
TEST(PhotonScene, LampsAreThoseOfTheSceneThatIsSeen) {
  Scene scene = with(room(12, true), room(6, true, 50));
  const auto straight = [&] {
    double sum = 0;
    for (const MapPhoton& p : photonsOf(scene, pool()))
      if (p.diffuseBefore == 0) sum += double(p.flux.x);
    return sum;
  };
  const double point = 4 * double(kPi) * 0.5, area = double(kPi) * 0.2 * 3;
  EXPECT_NEAR(straight(), point + area, 0.03 * (point + area));
  scene.lights[0].intensity = Vec3(0);
  EXPECT_NEAR(straight(), area, 0.02 * area);
}

// Hits lie on the simpler scene's walls, and on nothing else.
TEST(PhotonScene, HitsLieOnTheSimplerScene) {
  SceneBuilder small;
  small.box(small.material(testing::matte(Vec3(0.5f))), Vec3(-0.9f), Vec3(0.9f), true);
  const auto photons = photonsOf(with(room(12, false), small.build()), pool());
  ASSERT_GT(photons.size(), 2000u);
  for (const MapPhoton& p : photons) EXPECT_NEAR(maxComponent(glm::abs(p.position)), 0.9f, 1e-5f);
}

// A ball of 24 rings and one of 8: the mean of the picture, bounced light from the pool, is the
// same but for 2 %.
TEST(PhotonScene, APictureOfFinerThingsIsAsItWas) {
  Settings s = pool();
  s.mapDirect = MapDirect::off, s.mapPhotons = 20000, s.mapPerFrame = 5000, s.mapNearest = 50;
  const Scene fine = room(24, true), simple = with(fine, room(8, true));
  const Tracer itself(fine, Isa::automatic), other(simple, Isa::automatic);
  const auto expected = testing::render(itself, s, 16), image = testing::render(other, s, 16);
  const double error = std::hypot(image.error(), expected.error());
  EXPECT_NEAR(image.grey(), expected.grey(), 4 * error + 0.02 * expected.grey());
  EXPECT_LT(error, 0.02 * expected.grey());
  EXPECT_NE(image.pixels, expected.pixels);
}

}  // namespace
}  // namespace ninefold
