// Another camera on the same light is what a new renderer would be, bit for bit, by every method;
// where light is made for a view, each makes its own.
#include <gtest/gtest.h>

#include "common/scene/methods.h"
#include "tests/gi/make_scene.h"
#include "tests/gi/render.h"

namespace ninefold {
namespace {

Scene room() {
  testing::SceneBuilder b;
  const int grey = b.material(testing::matte(Vec3(0.6f)));
  const int lamp = b.material(testing::matte(Vec3(0), Vec3(10)));
  b.box(grey, Vec3(-1), Vec3(1), true);
  b.quad(lamp, Vec3(-0.3f, 0.99f, -0.3f), Vec3(0.6f, 0, 0), Vec3(0, 0, 0.6f));
  b.camera(Vec3(0, 0, 0.95f), Vec3(0, -0.25f, -1), 1.2f);
  return b.build();
}

void expectTheSameBytes(const Tracer& tracer, const MethodFacts& facts) {
  Settings first = testing::small(facts.method);
  first.camera = tracer.scene().cameras.front();
  Settings second = first;
  second.camera.eye = Vec3(0.5f, 0.1f, 0.7f), second.camera.verticalFov = 0.7f;
  second.width = 20, second.height = 15;

  const Renderer original(tracer, first), shared(original, second), fresh(tracer, second);
  const Renderer& lit = facts.lightNeedsView ? shared : original;
  const FrameKey key{3, 3, 3, 0.1f};
  const auto oneState = wholeState(lit, first, key.randomization);
  const auto otherState = wholeState(fresh, second, key.randomization);
  TileResult a, c;
  const auto scratch = original.makeScratch(), other = fresh.makeScratch();
  for (int phase = 0; phase < 9; ++phase) {
    const int set = lightSetOfPhase(phase, key.rotation, 9);
    shared.render(Task{key, 0, phase, 7}, *lit.light(key, set, oneState.get()), *scratch, a);
    fresh.render(Task{key, 0, phase, 7}, *fresh.light(key, set, otherState.get()), *other, c);
    EXPECT_EQ(a.layers, c.layers) << facts.name;
    EXPECT_EQ(a.extras, c.extras) << facts.name;
    EXPECT_EQ(a.width * a.height, TileGrid(20, 15, {3, 3}).rect(0, phase).count());
  }
}

TEST(View, AnotherCameraOnTheSameLightGivesTheBytesOfANewRenderer) {
  const Scene scene = room();
  const Tracer tracer(scene, Isa::automatic);
  for (const MethodFacts& facts : allMethods()) expectTheSameBytes(tracer, facts);
}

}  // namespace
}  // namespace ninefold
