// Candidates of a light set in batches: sizes, and the light of many batches.
#include "common/gi/bidirectional/batches.h"

#include <gtest/gtest.h>

#include "common/gi/light_set/light_set.h"
#include "tests/gi/expect.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

TEST(Batches, OfUsualSetsThereIsOne) {
  EXPECT_EQ(batchesLog2(Settings{}), 0);
  Settings s;
  s.resampling = 1000, s.directVpls = 24, s.indirectVpls = 500;  // 1,024,000 candidates
  EXPECT_EQ(batchesLog2(s), 7);
}

TEST(Batches, PartsAddUp) {
  for (const int n : {0, 3, 22, 1000, 1 << 20}) {
    Batch batch{0, 7};
    int sum = 0;
    for (; batch.index < batch.count(); ++batch.index) sum += batch.partOf(n);
    EXPECT_EQ(sum, n);
  }
}

TEST(Batches, HaveRandomNumbersOfTheirOwn) {
  const FrameKey frame{7, 9, 1, 0.1f};
  EXPECT_EQ((Batch{0, 3}.keyOf(frame).randomization), frame.randomization);
  EXPECT_NE((Batch{1, 3}.keyOf(frame).randomization), (Batch{2, 3}.keyOf(frame).randomization));
}

// A closed room of albedo 1/2 that emits 1 shows 1/(1 - 1/2) = 2, with a box of the same in it.
// 100 VPLs a set, a hundred and more candidates for each: four batches, each of the mean 2.
TEST(Batches, BringTheLightOfOneSet) {
  SceneBuilder b;
  const int grey = b.material(testing::matte(Vec3(0.5f), Vec3(1)));
  b.box(grey, Vec3(-1), Vec3(1), true);
  b.box(grey, Vec3(-0.4f, -0.9f, -0.4f), Vec3(0.1f, -0.2f, 0.3f), false);
  const Scene scene = b.camera(Vec3(0, 0, 0.9f), Vec3(0, -0.3f, -1), 1.5f).build();
  const Tracer tracer(scene, Isa::automatic);
  Settings s = testing::small(Method::bidirectional, 8);
  s.interleave = {1, 1};
  s.directVpls = 20, s.indirectVpls = 80, s.resampling = 100, s.cameraPoints = 16;
  ASSERT_EQ(batchesLog2(s), 2);
  const auto image = testing::render(tracer, s, 12);
  EXPECT_NEAR(image.grey(), 2, 5 * image.error() + 2e-4);
  EXPECT_LT(image.error(), 0.04);
  s.camera = scene.cameras.front();
  const auto light = Renderer(tracer, s).light({0, 0, 0, 0.1f}, 0);
  const auto& vpls = static_cast<const LightSet&>(*light).vpls;
  EXPECT_GT(vpls.size(), 80u);
  EXPECT_LE(vpls.size(), 104u);
}

}  // namespace
}  // namespace ninefold
