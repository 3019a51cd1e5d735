// --partition equal, the published form of bidirectional instant radiosity: the density of reverse
// VPLs is estimated, from one camera point that saw them and others that may not.
#include <gtest/gtest.h>

#include "common/gi/bidirectional/camera_points.h"
#include "common/gi/bidirectional/reverse_density.h"
#include "common/gi/bidirectional/reverse_places.h"
#include "tests/gi/expect.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

// A closed room of albedo 1/2 that emits 1, with a box of the same in it that hides its walls from
// many camera points. Whatever stands in a furnace, it shows 1/(1 - 1/2) = 2.
Scene furnaceWithABox() {
  SceneBuilder b;
  const int grey = b.material(testing::matte(Vec3(0.5f), Vec3(1)));
  b.box(grey, Vec3(-1), Vec3(1), true);
  b.box(grey, Vec3(-0.4f, -0.9f, -0.4f), Vec3(0.1f, -0.2f, 0.3f), false);
  return b.camera(Vec3(0, 0, 0.9f), Vec3(0, -0.3f, -1), 1.5f).build();
}

Settings equalSplit(int cameraPoints) {
  Settings s = testing::small(Method::bidirectional, 8);
  s.partition = PartitionRule::equal;
  s.interleave = {1, 1};
  s.directVpls = 16, s.indirectVpls = 64;
  s.resampling = 3, s.cameraPoints = cameraPoints;
  return s;
}

// With few camera points q is far off, and places are often seen by none of them. What is lost or
// found twice then would show.
TEST(EqualPartition, LosesNothingHoweverFewPointsTellTheDensity) {
  const Scene scene = furnaceWithABox();
  const Tracer tracer(scene, Isa::automatic);
  for (const int cameraPoints : {5, 50}) {
    const auto image = testing::render(tracer, equalSplit(cameraPoints), 800);
    const std::string what = std::to_string(cameraPoints) +
                             " camera points: " + testing::number(image.grey()) + " +- " +
                             testing::number(image.error());
    EXPECT_NEAR(image.grey(), 2, 4 * image.error()) << what;
    EXPECT_LT(image.error(), 0.01) << what;
    RecordProperty("points" + std::to_string(cameraPoints), what);
  }
}

// p(x, y) of the ray that was shot is what the density of one camera point is.
TEST(EqualPartition, EachPlaceKnowsTheDensityOfItsRay) {
  const Scene scene = furnaceWithABox();
  const Tracer tracer(scene, Isa::automatic);
  const Transport t(tracer, equalSplit(50));
  Settings s = t.settings;
  s.camera = scene.cameras.front();
  const View view = viewOf(t, s);
  RayCounts rays;
  const FrameKey key{0, 0, 0, 0.1f};
  const CameraPoints one = cameraPoints(t, {&view, 1}, key, 0, 1, rays);
  ASSERT_EQ(one.points.size(), 1u);
  const auto places = reversePlaces(t, one.points, key, 0, 100, rays);
  ASSERT_EQ(places.size(), 100u);
  for (const ReversePlace& y : places) {
    const float q = reverseDensity(t, one.points, y.place, y.drawnFrom, rays);
    EXPECT_NEAR(y.density, q, 1e-3f * q);
  }
}

}  // namespace
}  // namespace ninefold
