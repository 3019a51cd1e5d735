// Which frames a session opens while its picture changes, under a clock of the test.
#include "master/running/live_plan.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "common/image/layers.h"

namespace ninefold {
namespace {

class LivePlanTest : public testing::Test {
 protected:
  static LivePlan::Setup setup() {
    LivePlan::Setup s;
    s.state.settings.width = 64, s.state.settings.height = 48;
    s.sceneRadius = 5, s.state.settings.photonRadius = 0.02f;
    return s;
  }
  void pass(Duration time) { now += time; }
  std::optional<uint32_t> moveTo(float x) {
    LiveState state = plan.state();
    state.settings.camera.eye.x = x;
    return plan.change(state, now);
  }
  LiveFrame opened() {
    const auto frame = plan.next(now);
    EXPECT_TRUE(frame);
    return frame.value_or(LiveFrame{});
  }
  void finish(const LiveFrame& frame) { EXPECT_TRUE(plan.completed(frame.order.key.frame, now)); }
  // A frame opened and done in 20 ms.
  LiveFrame done() {
    const LiveFrame frame = opened();
    pass(milliseconds(20));
    finish(frame);
    return frame;
  }

  Time now = Time(std::chrono::hours(1));
  LivePlan plan{setup(), now};
};

TEST_F(LivePlanTest, AtRestFramesFollowOneAnotherAsInAHeadlessRun) {
  FramePlan headless(5 * 0.02f, 9, true);
  for (uint32_t i = 0; i < 20; ++i) {
    const LiveFrame frame = done();
    const FrameKey key = headless.next();
    EXPECT_FALSE(frame.moving);
    EXPECT_EQ(frame.rested, i);
    EXPECT_EQ(frame.order.key.randomization, key.randomization);
    EXPECT_EQ(frame.order.key.rotation, key.rotation);
    EXPECT_EQ(frame.order.key.photonRadius, key.photonRadius);
    EXPECT_EQ(frame.neighbourWeight, headless.neighbourWeight(i));
    EXPECT_EQ(frame.order.job, 1u);
  }
}

TEST_F(LivePlanTest, AChangeAtRestSupersedesWhatIsOpen) {
  const LiveFrame old = opened();
  const auto wanted = moveTo(1);
  ASSERT_TRUE(wanted);
  EXPECT_GT(*wanted, old.order.key.frame);
  EXPECT_FALSE(plan.completed(old.order.key.frame, now));
  const LiveFrame frame = opened();
  EXPECT_EQ(frame.order.key.frame, *wanted);
  EXPECT_TRUE(frame.moving);
  EXPECT_EQ(frame.order.settings.camera.eye.x, 1);
  EXPECT_GT(frame.order.job, old.order.job);
}

TEST_F(LivePlanTest, WhatDoesNotChangeAnythingSupersedesNothing) {
  opened();
  EXPECT_FALSE(plan.change(plan.state(), now));
  EXPECT_FALSE(plan.isMoving());
}

TEST_F(LivePlanTest, InMotionTheNewestStateWinsAndNoQueueGrows) {
  opened();
  moveTo(0);
  std::set<uint32_t> open;
  float last = -1;
  for (int i = 1; i <= 200; ++i) {
    moveTo(static_cast<float>(i));
    if (const auto frame = plan.next(now)) {
      EXPECT_EQ(frame->order.settings.camera.eye.x, static_cast<float>(i));
      EXPECT_GT(frame->order.settings.camera.eye.x, last);
      last = frame->order.settings.camera.eye.x;
      open.insert(frame->order.key.frame);
    }
    EXPECT_LE(open.size(), LivePlan::kInMotion);
    if (i % 7 == 0) {  // the cluster is slower than the hand
      EXPECT_TRUE(plan.completed(*open.begin(), now));
      open.erase(open.begin());
    }
    pass(milliseconds(5));
  }
}

TEST_F(LivePlanTest, TheLastStateIsShownInMotionAndThenAtRest) {
  moveTo(3);
  const LiveFrame moving = done();
  EXPECT_FALSE(plan.next(now)) << "the hand may go on";
  pass(LivePlan::kSettle);
  const LiveFrame rest = done();
  EXPECT_FALSE(rest.moving);
  EXPECT_EQ(rest.rested, 0);
  EXPECT_EQ(rest.order.settings.camera, moving.order.settings.camera);
  EXPECT_EQ(rest.order.settings.width, 64);
  EXPECT_EQ(done().rested, 1);
}

TEST_F(LivePlanTest, RestWaitsForTheFramesOfTheMotion) {
  moveTo(3);
  const LiveFrame moving = opened();
  pass(2 * LivePlan::kSettle);
  EXPECT_FALSE(plan.next(now));
  finish(moving);
  EXPECT_FALSE(opened().moving);
}

TEST_F(LivePlanTest, RandomBitsCountsAndRadiusAreFrozenWithinAGesture) {
  for (int i = 0; i < 5; ++i) {  // the cluster is known to be slow
    const LiveFrame frame = opened();
    pass(milliseconds(600));
    finish(frame);
  }
  moveTo(1);
  const LiveFrame first = opened();
  pass(milliseconds(90));
  finish(first);
  EXPECT_LT(first.order.settings.indirectVpls, 18);
  EXPECT_LT(first.order.settings.width, 64);
  std::mt19937 random(5);
  for (int i = 2; i < 100; ++i) {
    moveTo(static_cast<float>(i));
    const LiveFrame frame = opened();
    pass(milliseconds(20 + random() % 400));  // and changes its speed
    finish(frame);
    FrameKey key = frame.order.key;
    key.frame = first.order.key.frame;
    EXPECT_EQ(key.randomization, first.order.key.randomization);
    EXPECT_EQ(key.rotation, first.order.key.rotation);
    EXPECT_EQ(key.photonRadius, first.order.key.photonRadius);
    EXPECT_EQ(frame.order.settings.bound, first.order.settings.bound);
    EXPECT_EQ(frame.order.settings.directVpls, first.order.settings.directVpls);
    EXPECT_EQ(frame.order.settings.indirectVpls, first.order.settings.indirectVpls);
    EXPECT_EQ(frame.order.settings.photons, first.order.settings.photons);
  }
}

TEST_F(LivePlanTest, SomebodyWaitsForFramesInMotionAndForTheFirstAtRest) {
  EXPECT_TRUE(done().order.urgent);
  EXPECT_FALSE(done().order.urgent);
  moveTo(1);
  EXPECT_TRUE(done().order.urgent);
  pass(LivePlan::kSettle);
  EXPECT_TRUE(done().order.urgent);
  EXPECT_FALSE(done().order.urgent);
}

TEST_F(LivePlanTest, WhatNeedsManyFramesIsLeftOutInMotion) {
  const Settings atRest = done().order.settings;
  moveTo(1);
  const Settings moving = done().order.settings;
  EXPECT_EQ(moving.caustics, Caustics::direct);
  EXPECT_FALSE(moving.jitter);
  pass(LivePlan::kSettle);
  const Settings again = done().order.settings;
  EXPECT_EQ(again.caustics, atRest.caustics);
  EXPECT_TRUE(again.jitter);
}

TEST_F(LivePlanTest, LatencyCountsFromTheFirstChangeThatAFrameShows) {
  moveTo(1);
  const Time first = now;
  pass(milliseconds(30));
  moveTo(2);
  EXPECT_EQ(opened().changed, first);
  const Time second = now;
  moveTo(3);
  pass(milliseconds(10));
  moveTo(4);
  EXPECT_EQ(opened().changed, second);
}

// Frames overlap. Each of these keeps the cluster busy for 70 ms, but the second is waited for for
// 140.
TEST_F(LivePlanTest, TheWaitForTheFrameBeforeCountsAgainstTheTarget) {
  moveTo(1);
  const LiveFrame first = opened();
  moveTo(2);
  const LiveFrame second = opened();
  pass(milliseconds(70));
  finish(first);
  EXPECT_EQ(plan.quality().current().size, 0);
  pass(milliseconds(70));
  finish(second);
  EXPECT_GT(plan.quality().current().size, 0);
}

TEST_F(LivePlanTest, FramesAtRestThatShareTheClusterSayNothingAboutTheTimeOfOne) {
  done();
  std::vector<LiveFrame> frames;
  for (int i = 0; i < 7; ++i) frames.push_back(opened());
  pass(milliseconds(400));
  for (const LiveFrame& frame : frames) finish(frame);
  moveTo(1);
  EXPECT_EQ(plan.quality().current(), Quality{});
}

TEST_F(LivePlanTest, WithoutMotionEveryStateIsAStillOfItsOwn) {
  LivePlan::Setup stills = setup();
  stills.motion = false;
  plan = LivePlan(stills, now);
  for (int picture = 1; picture <= 5; ++picture) {
    EXPECT_TRUE(moveTo(static_cast<float>(picture)));
    for (uint32_t i = 0; i < 4; ++i) {
      const LiveFrame frame = done();
      EXPECT_FALSE(frame.moving);
      EXPECT_EQ(frame.rested, i);
      EXPECT_EQ(frame.order.key.randomization, i);
      EXPECT_EQ(frame.order.settings.camera.eye.x, static_cast<float>(picture));
    }
  }
}

TEST_F(LivePlanTest, AnEditedSceneIsAnnouncedAsMovingAndOnceMoreWhenItRests) {
  done();
  LiveState state = plan.state();
  uint32_t version = 0;
  for (int step = 1; step <= 3; ++step) {
    ++state.scene;
    plan.change(state, now);
    const LiveFrame frame = done();
    EXPECT_TRUE(frame.order.moving);
    EXPECT_EQ(frame.order.scene, ++version);
  }
  pass(LivePlan::kSettle);
  for (int i = 0; i < 3; ++i) {
    const LiveFrame frame = done();
    EXPECT_FALSE(frame.order.moving);
    EXPECT_EQ(frame.order.scene, 4u);
  }
  moveTo(7);  // the camera alone: nothing about the scene is to be said
  EXPECT_EQ(done().order.scene, 4u);
  pass(LivePlan::kSettle);
  EXPECT_EQ(done().order.scene, 4u);
}

// The form of results goes with the job; what it is at rest and in motion may change at any time.
TEST_F(LivePlanTest, FramesInMotionAndAtRestMayComeInDifferentForms) {
  Delivery codes;
  codes.form = Delivery::Form::display;
  Delivery radiance;
  radiance.form = Delivery::Form::radiance;
  EXPECT_EQ(done().order.job, 1u);
  plan.setDelivery(radiance, codes);
  const LiveFrame rest = done();
  EXPECT_EQ(rest.order.delivery, radiance);
  EXPECT_EQ(rest.order.job, 2u);
  EXPECT_EQ(rest.rested, 1) << "the picture is the same";
  moveTo(3);
  const LiveFrame moving = done();
  EXPECT_EQ(moving.order.delivery, codes);
  EXPECT_EQ(moving.order.job, 3u);
  codes.exposure = 1;
  plan.setDelivery(radiance, codes);
  pass(LivePlan::kSettle);
  EXPECT_EQ(done().order.delivery, radiance);
  EXPECT_EQ(done().order.job, 4u) << "the exposure in motion is nothing to a picture at rest";
}

TEST_F(LivePlanTest, AStillHasAsManyFramesAsItShallHave) {
  LivePlan::Setup still = setup();
  still.motion = false, still.frames = 2;
  plan = LivePlan(still, now);
  for (const float x : {0.0f, 3.0f}) {
    if (x > 0) moveTo(x);
    EXPECT_EQ(done().rested, 0);
    EXPECT_EQ(done().rested, 1);
    EXPECT_FALSE(plan.next(now));
  }
}

// Somebody looks on: a picture that rests has so many frames, then nothing is done any more until
// it moves or is looked at in another way.
TEST_F(LivePlanTest, APictureThatIsWatchedHasAsManyFramesAsItShallHave) {
  LivePlan::Setup watched = setup();
  watched.frames = 3;
  plan = LivePlan(watched, now);
  const auto expectRest = [&](int64_t from, int64_t to) {
    for (int64_t i = from; i < to; ++i) {
      const LiveFrame frame = done();
      EXPECT_EQ(frame.rested, i);
      EXPECT_EQ(frame.last, i + 1 == to);
    }
    EXPECT_FALSE(plan.next(now));
    EXPECT_FALSE(plan.nextStep(now));
  };
  expectRest(0, 3);
  LiveState state = plan.state();
  state.look = 2;
  plan.change(state, now);
  expectRest(3, 6);
  state.look = 3;
  plan.change(state, now);
  EXPECT_FALSE(done().last);
  const LiveFrame open = opened();
  state.look = 4;
  plan.change(state, now);
  EXPECT_FALSE(plan.completed(open.order.key.frame, now));
  expectRest(7, 10);
  moveTo(1);
  const LiveFrame moving = done();
  EXPECT_TRUE(moving.moving);
  EXPECT_FALSE(moving.last);
  pass(LivePlan::kSettle);
  expectRest(0, 3);
}

TEST_F(LivePlanTest, WhatNobodyCanRenderAnyMoreIsShownByOtherFrames) {
  done();
  opened();  // the second at rest
  EXPECT_EQ(plan.giveUp(), 2u);
  const LiveFrame again = done();
  EXPECT_EQ(again.order.key.frame, 2u);
  EXPECT_EQ(again.rested, 0) << "the film begins anew";
  moveTo(7);
  const LiveFrame moving = opened();
  EXPECT_EQ(plan.giveUp(), 4u);
  EXPECT_FALSE(plan.completed(moving.order.key.frame, now));
  const LiveFrame other = opened();
  EXPECT_TRUE(other.moving);
  EXPECT_EQ(other.order.settings.camera.eye.x, 7);
  EXPECT_EQ(other.order.job, moving.order.job);
}

// A look at the same light: what is open is opened anew with it, from the first frame that is not
// complete.
TEST_F(LivePlanTest, AnotherLookRestsOn) {
  FramePlan headless(5 * 0.02f, 9, true);
  for (int i = 0; i < 3; ++i) done(), headless.next();
  const LiveFrame open = opened(), ahead = opened();
  LiveState state = plan.state();
  state.look = 2, state.extraMask = kNormalPlane;
  const auto wanted = plan.change(state, now);
  ASSERT_TRUE(wanted);
  EXPECT_FALSE(plan.isMoving());
  EXPECT_FALSE(plan.completed(open.order.key.frame, now));
  EXPECT_FALSE(plan.completed(ahead.order.key.frame, now));
  for (int64_t i = 3; i < 6; ++i) {
    const LiveFrame frame = done();
    const FrameKey key = headless.next();
    EXPECT_EQ(frame.order.key.frame, *wanted + static_cast<uint32_t>(i - 3));
    EXPECT_EQ(frame.rested, i);
    EXPECT_EQ(frame.order.key.randomization, key.randomization);
    EXPECT_EQ(frame.order.key.photonRadius, key.photonRadius);
    EXPECT_EQ(frame.order.extraMask, kNormalPlane);
    EXPECT_EQ(frame.order.urgent, i == 3) << "somebody waits for the new look";
    EXPECT_EQ(frame.order.job, open.order.job);
  }
}

TEST_F(LivePlanTest, ALookInMotionIsShownInMotion) {
  moveTo(1);
  opened();
  LiveState state = plan.state();
  state.look = 2;
  EXPECT_FALSE(plan.change(state, now));
  EXPECT_TRUE(opened().moving);
}

// Nobody who cannot click pays for the planes; who can finds them in the first frame of each rest.
TEST_F(LivePlanTest, TheFirstFrameAtRestCarriesPickPlanesIfSomebodyMayClick) {
  EXPECT_EQ(done().order.extraMask, 0);
  LivePlan::Setup person = setup();
  person.picks = true;
  plan = LivePlan(person, now);
  Delivery radiance, codes;
  radiance.form = Delivery::Form::radiance;
  codes.form = Delivery::Form::display, codes.exposure = 1;
  plan.setDelivery(radiance, codes);
  for (int rest = 0; rest < 2; ++rest) {
    const LiveFrame first = done(), second = done();
    EXPECT_EQ(first.order.extraMask, kPickPlanes);
    EXPECT_EQ(first.order.delivery, Delivery{}) << "planes come as layers";
    EXPECT_EQ(second.order.extraMask, 0);
    EXPECT_EQ(second.order.delivery, radiance);
    moveTo(static_cast<float>(rest + 1));
    EXPECT_EQ(done().order.extraMask, 0);
    pass(LivePlan::kSettle);
  }
}

TEST_F(LivePlanTest, ASelectionIsNoChangeAtRestAndIsThereInMotion) {
  done();
  const LiveFrame open = opened();
  LiveState state = plan.state();
  state.picks = true;
  EXPECT_FALSE(plan.change(state, now));
  finish(open);
  const LiveFrame next = done();
  EXPECT_EQ(next.rested, 2);
  EXPECT_EQ(next.order.extraMask, 0);
  moveTo(1);
  EXPECT_EQ(done().order.extraMask, kPickPlanes);
}

// Light that is made for a view: in motion each frame's camera takes the place of the oldest of
// eight.
TEST_F(LivePlanTest, LightInMotionIsMadeForTheLastEightCameras) {
  LivePlan::Setup needing = setup();
  needing.state.settings.method = Method::bidirectional;
  needing.state.settings.camera.name = "door";
  plan = LivePlan(needing, now);
  EXPECT_TRUE(done().order.key.lightCameras.empty());
  const auto xs = [](const LiveFrame& frame) {
    std::vector<float> all;
    for (const Camera& camera : frame.order.key.lightCameras) {
      EXPECT_EQ(camera.name, "") << "a name is no part of the light";
      all.push_back(camera.eye.x);
    }
    return all;
  };
  using Xs = std::vector<float>;
  const auto walked = [&](float x) { return moveTo(x), xs(done()); };
  EXPECT_EQ(walked(1), Xs({1, 1, 1, 1, 1, 1, 1, 1}));
  EXPECT_EQ(walked(2), Xs({1, 2, 1, 1, 1, 1, 1, 1}));
  for (int x = 3; x < 9; ++x) walked(static_cast<float>(x));
  EXPECT_EQ(walked(9), Xs({9, 2, 3, 4, 5, 6, 7, 8}));
  pass(LivePlan::kSettle);
  EXPECT_TRUE(done().order.key.lightCameras.empty());
  EXPECT_EQ(walked(10), Xs(8, 10)) << "a new gesture may begin far away";
}

TEST_F(LivePlanTest, VplsInMotionHaveHalfAsManyCandidates) {
  moveTo(1);
  const Settings standard = done().order.settings;
  EXPECT_EQ(standard.resampling, Settings{}.resampling) << "it has no use for them";
  LivePlan::Setup choosing = setup();
  choosing.state.settings.method = Method::bidirectional;
  choosing.state.settings.resampling = 1;
  plan = LivePlan(choosing, now);
  moveTo(1);
  const Settings s = done().order.settings;
  EXPECT_EQ(s.resampling, 1);
  EXPECT_EQ(s.cameraPoints, Settings{}.cameraPoints / 2);
  EXPECT_EQ(s.indirectVpls, Settings{}.indirectVpls);
}

TEST_F(LivePlanTest, LightThatNeedsNoViewIsMadeForNone) {
  moveTo(1);
  EXPECT_TRUE(done().order.key.lightCameras.empty());
}

TEST_F(LivePlanTest, JobsGrowOnlyWhenSomethingDiffers) {
  const uint32_t before = done().order.job;
  LiveState state = plan.state();
  state.scene = 1;
  plan.change(state, now);
  const LiveFrame edited = done();
  EXPECT_GT(edited.order.job, before);
  EXPECT_EQ(edited.order.scene, 1u);
  pass(LivePlan::kSettle);
  const uint32_t rest = done().order.job;
  EXPECT_EQ(done().order.job, rest);
}

// --- motion blur ---

class ShutterTest : public LivePlanTest {
 protected:
  ShutterTest() { plan = LivePlan(stillSetup(), now), plan.openShutter(); }
  static LivePlan::Setup stillSetup() {
    LivePlan::Setup s = setup();
    s.motion = false, s.frames = 4;
    return s;
  }
  void expose(float x) {
    LiveState state = plan.state();
    state.settings.camera.eye.x = x;
    plan.expose(state, now);
  }
};

TEST_F(ShutterTest, EachMomentGetsOneFrameOfOneFilm) {
  FramePlan still(5 * 0.02f, 9, true);
  for (uint32_t k = 0; k < 4; ++k) {
    ASSERT_EQ(plan.wantedMoment(), k);
    EXPECT_FALSE(plan.next(now)) << "before its moment";
    expose(static_cast<float>(k));
    EXPECT_FALSE(plan.wantedMoment()) << "until the frame is open";
    const LiveFrame frame = done();
    EXPECT_FALSE(plan.next(now)) << "of the same moment";
    EXPECT_EQ(frame.rested, k);
    EXPECT_EQ(frame.order.settings.camera.eye.x, static_cast<float>(k));
    EXPECT_EQ(frame.order.key.randomization, still.next().randomization);
    EXPECT_FALSE(frame.moving);
  }
}

TEST_F(ShutterTest, FramesOfTwoMomentsAreOpenAtMost) {
  expose(0);
  const LiveFrame first = opened();
  EXPECT_EQ(plan.wantedMoment(), 1);
  expose(1);
  opened();
  EXPECT_FALSE(plan.wantedMoment());
  finish(first);
  EXPECT_EQ(plan.wantedMoment(), 2);
}

TEST_F(ShutterTest, AMomentLikeTheOneBeforeIsAFrame) {
  expose(3);
  done();
  expose(3);
  EXPECT_EQ(done().rested, 1);
}

TEST_F(ShutterTest, TheNextPictureBeginsAnew) {
  expose(0);
  const LiveFrame left = opened();
  plan.openShutter();
  EXPECT_FALSE(plan.completed(left.order.key.frame, now));
  EXPECT_EQ(plan.wantedMoment(), 0);
  expose(0);
  EXPECT_EQ(done().rested, 0);
}

TEST_F(ShutterTest, WhenAllClientsAreGoneThePictureBeginsAnewWithItsFirstMoment) {
  expose(0);
  done();
  expose(1);
  opened();
  plan.giveUp();
  EXPECT_EQ(plan.wantedMoment(), 0);
  EXPECT_FALSE(plan.next(now));
}

}  // namespace
}  // namespace ninefold
