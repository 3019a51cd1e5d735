// A client that followed a session of random edits and one that came late give the same bytes, by
// every method. A scene that was edited before it was traced has the same surfaces, where rounding
// leaves no choice.
#include <gtest/gtest.h>

#include <array>

#include "client/render_job.h"
#include "common/scene/methods.h"
#include "tests/scene/random_edits.h"
#include "tests/scene/table_room.h"

namespace ninefold {
namespace {

constexpr int kEdits = 1000;

Settings smallPicture(const Scene& scene, Method method) {
  Settings s;
  s.method = method;
  s.width = 96, s.height = 72;
  s.camera = scene.cameras.front();
  return s;
}

// All tasks of a frame, as they would travel. `state`: the version of `pages`; 0: without a state.
std::vector<Bytes> render(RenderJob& job, uint32_t state, const StatePages& pages) {
  FrameKey key;
  key.photonRadius = 0.05f, key.state = state;
  std::vector<Bytes> tiles;
  for (uint32_t phase = 0; phase < 9; ++phase)
    tiles.push_back(job.run(
                           key, {0, phase, 0}, 1, 1, 0, [] { return Time(); }, pages)
                        .result.encoded);
  return tiles;
}

std::vector<Bytes> render(const std::shared_ptr<const TracedScene>& scene, Method method) {
  RenderJob job(scene, 1, smallPicture(*scene->scene, method), {}, 1);
  return render(job, 0, {});
}

TEST(Edits, AThousandFollowedOrTakenAtOnceGiveTheSameBytes) {
  const auto read = std::make_shared<const Scene>(tableRoomWithSpot());
  const auto asRead = std::make_shared<const TracedScene>(read, Isa::automatic);
  RandomEdits random(*read, 7);
  SceneEdit all;
  std::shared_ptr<const TracedScene> followed = asRead;
  int compared = 0;
  for (int i = 1; i <= kEdits; ++i) {
    merge(all, random.next());
    ASSERT_NO_THROW(checkEdit(*read, all));
    followed = std::make_shared<const TracedScene>(*followed, all);
    if (i % 250 != 0 && i != 1) continue;
    const auto fresh = std::make_shared<const TracedScene>(
        TracedScene(std::make_shared<const Scene>(*read), Isa::automatic), all);
    for (const MethodFacts& by : allMethods())
      EXPECT_EQ(render(followed, by.method), render(fresh, by.method))
          << by.name << " after " << i << " edits";
    ++compared;
  }
  EXPECT_EQ(compared, 5);
  for (const MethodFacts& by : allMethods())
    EXPECT_NE(render(followed, by.method), render(asRead, by.method)) << by.name;
}

// One that saw a gesture begin, step by step, and one that comes in the middle of it.
TEST(Edits, AGestureFollowedOrTakenAtOnceGivesTheSameBytes) {
  const auto read = std::make_shared<const Scene>(tableRoomWithSpot());
  const auto asRead = std::make_shared<const TracedScene>(read, Isa::automatic);
  RandomEdits random(*read, 6);
  SceneEdit settled;
  for (int i = 0; i < 10; ++i) merge(settled, random.next());
  const auto begun = std::make_shared<const TracedScene>(*asRead, settled);
  SceneEdit all = settled;
  std::shared_ptr<const TracedScene> followed = begun;
  for (int i = 0; i < 10; ++i) {
    merge(all, random.next());
    followed = std::make_shared<const TracedScene>(*followed, all, begun);
  }
  const TracedScene late(std::make_shared<const Scene>(*read), Isa::automatic);
  const auto lateBegun = std::make_shared<const TracedScene>(late, settled);
  const auto inTheMiddle = std::make_shared<const TracedScene>(*lateBegun, all, lateBegun);
  const auto atRest = std::make_shared<const TracedScene>(late, all);
  for (const MethodFacts& by : allMethods()) {
    EXPECT_EQ(render(followed, by.method), render(inTheMiddle, by.method)) << by.name;
    EXPECT_NE(render(followed, by.method), render(atRest, by.method)) << by.name;
  }
}

// Two gestures with rest between them, one job after another. Who comes late has the same light.
TEST(Edits, AStateInGesturesIsTheSameForWhoComesLate) {
  const auto read = std::make_shared<const Scene>(tableRoomWithSpot());
  const TracedScene late(std::make_shared<const Scene>(*read), Isa::automatic);
  for (const MethodFacts& by : allMethods()) {
    if (by.state == nullptr) continue;
    const Settings settings = smallPicture(*read, by.method);
    RandomEdits random(*read, 8);
    SceneEdit all, settled;
    auto scene = std::make_shared<const TracedScene>(read, Isa::automatic);
    auto job = std::make_unique<RenderJob>(scene, 1, settings, Delivery{}, 1);
    const std::array<StatePages, 2> pages = {job->stateAtRest(0), job->stateAtRest(1)};
    std::shared_ptr<const TracedScene> begun;
    for (int step = 0; step < 8; ++step) {
      const bool rests = step % 4 == 3;
      if (step % 4 == 0) begun = scene, settled = all;
      merge(all, random.next());
      scene = std::make_shared<const TracedScene>(*scene, all, rests ? nullptr : begun);
      job = std::make_unique<RenderJob>(scene, 1, settings, Delivery{}, 1, job.get());
      const uint32_t version = 1 + step % 2;
      const std::vector<Bytes> followed = render(*job, version, pages[version - 1]);
      if (step % 4 == 0) continue;
      const auto lateBegun = rests ? nullptr : std::make_shared<const TracedScene>(late, settled);
      const auto lateScene =
          std::make_shared<const TracedScene>(rests ? late : *lateBegun, all, lateBegun);
      RenderJob fresh(lateScene, 1, settings, Delivery{}, 1);
      EXPECT_EQ(followed, render(fresh, version, pages[version - 1])) << by.name << ", " << step;
    }
  }
}

// The other order of building: edited first, traced in one hierarchy.
TEST(Edits, PartsOfTheirOwnSeeWhatOneHierarchySees) {
  const auto read = std::make_shared<const Scene>(tableRoomWithSpot());
  const TracedScene asRead(read, Isa::automatic);
  RandomEdits random(*read, 11);
  SceneEdit all;
  for (int i = 0; i < 20; ++i) merge(all, random.next());
  const TracedScene apart(asRead, all);
  const Tracer whole(*apart.scene, Isa::automatic);
  std::mt19937 rays(3);
  std::uniform_real_distribution<float> unit(-1, 1);
  int hits = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 origin = 0.5f * Vec3(unit(rays), unit(rays), unit(rays));
    const Vec3 direction = glm::normalize(Vec3(unit(rays), unit(rays), unit(rays)));
    const Hit a = apart.tracer.closest(origin, direction, 100);
    const Hit b = whole.closest(origin, direction, 100);
    ASSERT_EQ(bool(a), bool(b));
    EXPECT_EQ(apart.tracer.occluded(origin, direction, 100), bool(b));
    if (!a) continue;
    ++hits;
    EXPECT_EQ(a.t, b.t);
    if (a.instance == b.instance && a.triangle == b.triangle) {
      EXPECT_EQ(apart.tracer.surface(a).position, whole.surface(b).position);
    }
  }
  EXPECT_GT(hits, 10000);
}

}  // namespace
}  // namespace ninefold
