// Orthographic pictures by every method: what parallel rays meet, near and far, and from inside of
// solids that their film cuts.
#include "tests/gi/expect.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

// Seen along -z from z = `eye`, `height` metres high.
Scene seenInPlan(SceneBuilder& b, float eye, float height) {
  Scene scene = b.camera(Vec3(0, 0, eye), Vec3(0, 0, eye - 1)).build();
  scene.cameras[0].orthographicHeight = height;
  return scene;
}

// A lamp of a quarter of the picture, whatever its distance: the picture's mean is L/4.
TEST(Orthographic, ThingsAreAsLargeAsTheyAreAtAnyDistance) {
  for (const float eye : {0.5f, 4.0f}) {
    SceneBuilder b;
    b.quad(b.material(testing::matte(Vec3(0), Vec3(2))), Vec3(-0.5f, -0.5f, -1), Vec3(1, 0, 0),
           Vec3(0, 1, 0));
    testing::expectRadiance(seenInPlan(b, eye, 2), testing::estimators(8), 0.5,
                            {.frames = 4, .bias = 1e-5, .error = 0.02},
                            "from " + testing::number(double(eye)));
  }
}

// A furnace, in which light has to be found for what such a camera sees.
TEST(Orthographic, MeetsTheGeometricSeries) {
  SceneBuilder b;
  b.box(b.material(testing::matte(Vec3(0.5f), Vec3(1))), Vec3(-1), Vec3(1), true);
  auto all = testing::estimators(12);
  for (auto& e : all) e.settings.directVpls = 64, e.settings.indirectVpls = 256;
  testing::expectRadiance(seenInPlan(b, 0.5f, 1.5f), all, 2,
                          {.frames = 24, .bias = 1e-5, .error = 0.02}, "furnace");
}

// The film stands inside of a block of absorbing glass of index 1, half of it: those rays lose
// light over the last part of the block, the others nothing.
TEST(Orthographic, RaysThatStartInsideOfASolidAreAbsorbedFromThereOn) {
  SceneBuilder b;
  Material smoke = testing::glass(1);
  smoke.attenuationColor = Vec3(0.5f), smoke.attenuationDistance = 1;
  b.box(b.material(smoke), Vec3(-5, -5, -1), Vec3(0, 5, 3), false);
  b.quad(b.material(testing::matte(Vec3(0), Vec3(1))), Vec3(-5, -5, -2), Vec3(10, 0, 0),
         Vec3(0, 10, 0));
  testing::expectRadiance(seenInPlan(b, 1, 2), testing::estimators(8), 0.5 * (0.25 + 1),
                          {.frames = 4, .bias = 1e-4, .error = 0.02}, "smoke");
}

}  // namespace
}  // namespace ninefold
