// The method auto: which method it chooses on the scenes that come with the program, and that its
// pictures are that method's, bit for bit. What is expected of each scene is what has less error
// after equal time: docs/performance.md.
#include <gtest/gtest.h>

#include "common/gi/whole_state.h"
#include "common/scene/method_trial.h"
#include "common/scene/methods.h"
#include "common/scene/reader.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

struct Shipped {
  explicit Shipped(const std::string& name, int width = 160, int height = 120)
      : scene(readScene(NINEFOLD_SCENES "/" + name + ".glb")), tracer(scene, Isa::automatic) {
    settings.method = Method::automatic;
    settings.width = width, settings.height = height;
    settings.camera = scene.cameras.front();
  }
  Method chosen() const {
    const Renderer renderer(tracer, settings);
    return kTried[verdictOf(stateAtRest(renderer, settings, 0)).chosen];
  }

  const Scene scene;
  const Tracer tracer;
  Settings settings;
};

void expectChoice(const std::string& scene, Method expected) {
  Shipped s(scene);
  for (const uint64_t seed : {1, 2, 3}) {
    s.settings.seed = seed;
    EXPECT_STREQ(factsOf(s.chosen()).name, factsOf(expected).name) << scene << ", seed " << seed;
  }
}

TEST(Automatic, LightRoundCornersIsFoundFromTheCamera) {
  for (const char* scene : {"u_office", "keyhole", "three_turns"})
    expectChoice(scene, Method::bidirectional);
}

TEST(Automatic, RoomsWithLampsAreLeftToInstantRadiosity) {
  for (const char* scene :
       {"table_room", "office", "conference", "cornell", "egg_room", "invisible_date"})
    expectChoice(scene, Method::instantRadiosity);
}

void expectPicturesOf(const std::string& scene, Method expected) {
  Shipped s(scene, 40, 30);
  const Renderer choosing(s.tracer, s.settings);
  Settings direct = s.settings;
  direct.method = expected;
  const Renderer fixed(s.tracer, direct);
  const auto state = wholeState(choosing, s.settings, 0);
  const auto scratch = choosing.makeScratch(), other = fixed.makeScratch();
  const FrameKey key{3, 3, 3, 0.1f};
  TileResult a, b;
  for (int phase = 0; phase < 9; ++phase) {
    const int set = lightSetOfPhase(phase, key.rotation, 9);
    const auto mine = choosing.light(key, set, state.get()), light = fixed.light(key, set);
    const Task task{key, 0, phase, 31};
    choosing.render(task, *mine, *scratch, a);
    fixed.render(task, *light, *other, b);
    EXPECT_EQ(a.layers, b.layers) << scene;
    EXPECT_EQ(a.extras, b.extras) << scene;
    EXPECT_EQ(mine->rays.total(), light->rays.total()) << scene;
  }
}

TEST(Automatic, PicturesAreThoseOfTheChosenMethod) {
  expectPicturesOf("table_room", Method::instantRadiosity);
  expectPicturesOf("u_office", Method::bidirectional);
}

TEST(Automatic, AUnitIsTheSameWhateverWasTriedBefore) {
  const Shipped s("cornell", 40, 30);
  const Renderer renderer(s.tracer, s.settings);
  StatePages pages;
  StepKey again;
  again.from = 1, again.to = 2, again.firstUnit = 40, again.randomization = 5;
  const PageDeltas first = renderer.step(pages, {}, 2).deltas;
  pages.apply(first);
  EXPECT_EQ(renderer.step(pages, again, 42).deltas, first);
}

TEST(Automatic, BlackAndEmptyPicturesAreLeftToTheFirst) {
  testing::SceneBuilder b;
  b.box(b.material(testing::matte(Vec3(0.5f))), Vec3(-1), Vec3(1), true);
  b.camera(Vec3(0, 0, 0.9f), Vec3(0, 0, -1));
  const Scene dark = b.build();
  const Tracer tracer(dark, Isa::automatic);
  Settings s;
  s.method = Method::automatic, s.camera = dark.cameras.front();
  for (const int side : {1, 2, 24}) {
    s.width = side, s.height = 1;
    const Renderer renderer(tracer, s);
    EXPECT_EQ(verdictOf(stateAtRest(renderer, s, 0)).chosen, 0u);
  }
}

}  // namespace
}  // namespace ninefold
