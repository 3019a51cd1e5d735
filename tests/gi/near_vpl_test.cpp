// Receivers arbitrarily near what lights them: in corners, in slits, under a lamp that all but
// touches the floor, at grazing angles. G grows without bound there, and the light must not.
#include "tests/gi/expect.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::number;
using testing::SceneBuilder;

// A furnace of albedo a and emission 1 shows 1/(1-a) everywhere, at any distance from its corner:
// also at 1 nm, where nearly all light comes by compensation. b is so low that virtual lights, rare
// near a given corner, carry next to nothing. A pool's disks are known to 3 % there.
TEST(NearVpl, CornersOfAFurnaceAreRightDownToANanometre) {
  for (const float distance : {1e-2f, 1e-5f, 1e-9f}) {
    SceneBuilder b;
    b.box(b.material(testing::matte(Vec3(0.5f), Vec3(1))), Vec3(0), Vec3(1), true);
    b.camera(Vec3(distance), Vec3(0), 0.7f);
    auto all = testing::estimators();
    for (auto& e : all) e.settings.bound = 0.01f;
    testing::expectRadiance(b.build(), all, 2, {.blur = 0.03}, number(distance) + " m");
  }
}

// The same in a slit of width h: light takes any number of bounces between the plates, so that with
// albedo 0.9 sixteen of them would lose 0.9^16 = 18 %.
TEST(NearVpl, SlitsTakeAsManyBouncesAsThereAre) {
  for (const float h : {0.1f, 1e-3f}) {
    SceneBuilder b;
    b.box(b.material(testing::matte(Vec3(0.9f), Vec3(1))), Vec3(-1, 0, -1), Vec3(1, h, 1), true);
    b.camera(Vec3(0, 0.5f * h, 0), Vec3(0.3f, 0, 0.2f), 0.7f);
    auto all = testing::estimators();
    for (auto& e : all) e.settings.bound = 0.01f;
    // Few lines of a field lie flat enough for the narrow one: 5.5 % are missing.
    const double blur = h < 0.01f ? 0.06 : 0.02;
    testing::expectRadiance(b.build(), all, 10, {.error = 0.02, .blur = blur}, number(h) + " m");
  }
}

// A lamp of radiance 1 at height h over a floor of albedo a, both 2S wide, h << S: what the floor
// sees is the lamp, E = pi (1 - O(h^2/S^2)), L = a after one diffuse vertex. The eye is between.
void expectLampFillsTheSky(float S, float h) {
  SceneBuilder b;
  b.quad(b.material(testing::matte(Vec3(0.5f))), Vec3(-S, 0, S), Vec3(2 * S, 0, 0),
         Vec3(0, 0, -2 * S));
  b.quad(b.material(testing::matte(Vec3(0), Vec3(1))), Vec3(-S, h, -S), Vec3(2 * S, 0, 0),
         Vec3(0, 0, 2 * S));
  b.camera(Vec3(0, 0.5f * h, 0), Vec3(0), 0.5f, Vec3(0, 0, 1));
  auto all = testing::estimators(8, 1);
  for (auto& e : all) e.settings.bound = 0.01f;
  testing::expectRadiance(b.build(), all, 0.5, {.bias = 1e-3}, number(h) + " m");
}

TEST(NearVpl, LampsAMicrometreFromAFloorOfAMetre) { expectLampFillsTheSky(1, 1e-6f); }
TEST(NearVpl, LampsANanometreFromAFloorOfTenMicrometres) { expectLampFillsTheSky(1e-5f, 1e-9f); }

// Nearer than the rounding of the larger one's coordinates (math/rounding.h: 2^-24 of a metre here)
// a lamp *is* in the floor's plane: it lights nothing, and spoils nothing.
TEST(NearVpl, LampsWithinRoundingOfTheFloorGiveNoLight) {
  for (const float h : {1e-9f, 0.0f}) {
    SceneBuilder b;
    b.quad(b.material(testing::matte(Vec3(0.5f))), Vec3(-1, 0, 1), Vec3(2, 0, 0), Vec3(0, 0, -2));
    b.quad(b.material(testing::matte(Vec3(0), Vec3(1))), Vec3(-0.1f, h, -0.1f), Vec3(0.2f, 0, 0),
           Vec3(0, 0, 0.2f));
    b.camera(Vec3(0.5f, 1, 0), Vec3(0.5f, 0, 0), 0.5f, Vec3(0, 0, 1));
    const Scene scene = b.build();
    const Tracer tracer(scene, Isa::automatic);
    for (const auto& e : testing::estimators())
      for (const Vec3& p : testing::render(tracer, e.settings, 8).pixels)
        EXPECT_EQ(p, Vec3(0)) << e.name;
  }
}

// A diffuse floor of albedo a under a sky of radiance 1 shows a from any side, also to an eye so
// low that it looks along it: cos = 1e-4.
TEST(NearVpl, FloorsSeenAtGrazingAnglesShowTheirRadiance) {
  SceneBuilder b;
  b.quad(b.material(testing::matte(Vec3(0.5f))), Vec3(-10, 0, 10), Vec3(20, 0, 0), Vec3(0, 0, -20));
  b.environment(Radiance(1)).camera(Vec3(0, 1e-3f, 9), Vec3(0, 0.5e-3f, 4), 2e-5f);
  testing::expectRadiance(b.build(), testing::estimators(), 0.5);
}

// ... and lit so: parallel light of irradiance E0 across itself, cos = 1e-4 to the floor's normal.
TEST(NearVpl, FloorsLitAtGrazingAnglesTakeTheirShare) {
  PunctualLight sun;
  sun.kind = LightKind::directional, sun.intensity = Vec3(2);
  sun.direction = glm::normalize(Vec3(1, -1e-4f, 0));
  SceneBuilder b;
  b.quad(b.material(testing::matte(Vec3(0.5f))), Vec3(-1, 0, 1), Vec3(2, 0, 0), Vec3(0, 0, -2));
  b.light(sun).camera(Vec3(0, 1, 0), Vec3(0), 0.5f, Vec3(0, 0, 1));
  const double expected = 2e-4 * 0.5 / static_cast<double>(kPi);
  testing::expectRadiance(b.build(), testing::estimators(), expected, {.frames = 4});
}

}  // namespace
}  // namespace ninefold
