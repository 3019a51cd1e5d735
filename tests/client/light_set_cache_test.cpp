#include "client/light_set_cache.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

#include "client/method_states.h"

namespace ninefold {
namespace {

// A set that nobody looks into: only its identity counts here.
LightSetCache::Shared someSet() {
  const auto holder = std::make_shared<int>(0);
  return {holder, reinterpret_cast<const FrameLight*>(holder.get())};
}

FrameKey frameOf(uint32_t randomization) {
  FrameKey key;
  key.frame = key.randomization = randomization;
  return key;
}

TEST(LightSetCache, ManyThreadsShareOneSetMadeOnce) {
  std::atomic<int> made = 0;
  LightSetCache cache(
      [&](const FrameKey&, int, const MethodState*) {
        ++made;
        std::this_thread::yield();
        return someSet();
      },
      2);
  std::vector<LightSetCache::Shared> got(8);
  std::vector<std::thread> threads;
  for (auto& set : got) threads.emplace_back([&] { set = cache.get(frameOf(5), 3).set; });
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(made, 1);
  for (const auto& set : got) EXPECT_EQ(set, got[0]);
}

TEST(LightSetCache, FramesThatDifferOnlyInNumberAndRotationShare) {
  LightSetCache cache([](const FrameKey&, int, const MethodState*) { return someSet(); }, 2);
  FrameKey moving = frameOf(1);
  const auto first = cache.get(moving, 0).set;
  moving.frame = 17, moving.rotation = 4;
  EXPECT_EQ(cache.get(moving, 0).set, first);
  EXPECT_FALSE(cache.get(moving, 0).madeHere);
  moving.photonRadius = 0.5f;
  const auto other = cache.get(moving, 0);
  EXPECT_NE(other.set, first);
  EXPECT_TRUE(other.madeHere);
  moving.lightCameras.resize(8);
  const auto seen = cache.get(moving, 0).set;
  EXPECT_EQ(cache.get(moving, 0).set, seen);
  EXPECT_NE(seen, other.set);
  moving.lightCameras[3].eye.x = 1;
  EXPECT_NE(cache.get(moving, 0).set, seen) << "light for another camera";
}

TEST(LightSetCache, KeepsTheFramesUsedLastAndForgetsOlderOnes) {
  int made = 0;
  LightSetCache cache(
      [&](const FrameKey&, int, const MethodState*) {
        ++made;
        return someSet();
      },
      2);
  const std::weak_ptr<const FrameLight> first = cache.get(frameOf(1), 0).set;
  cache.get(frameOf(2), 0);
  cache.get(frameOf(1), 0);  // used again: 2 is now the oldest
  cache.get(frameOf(3), 0);
  EXPECT_EQ(made, 3);
  EXPECT_FALSE(first.expired());
  cache.get(frameOf(4), 0);
  EXPECT_TRUE(first.expired());
}

TEST(LightSetCache, AFailureReachesTheCallerThroughTheFuture) {
  LightSetCache cache(
      [](const FrameKey&, int, const MethodState*) -> LightSetCache::Shared {
        throw std::runtime_error("no memory");
      },
      2);
  EXPECT_THROW(cache.get(frameOf(1), 0), std::runtime_error);
  EXPECT_THROW(cache.get(frameOf(1), 0), std::runtime_error);
}

// Another master may give another state the same number.
TEST(LightSetCache, AnotherStateIsAnotherLight) {
  int made = 0;
  LightSetCache cache([&](const FrameKey&, int, const MethodState*) { return ++made, someSet(); },
                      4);
  FrameKey key;
  key.state = 3;
  const auto one = std::make_shared<const MethodState>();
  const auto other = std::make_shared<const MethodState>();
  const auto set = cache.get(key, 0, one).set;
  EXPECT_EQ(cache.get(key, 0, one).set, set);
  EXPECT_NE(cache.get(key, 0, other).set, set);
  EXPECT_EQ(made, 2);
}

TEST(LightSetCache, ASetKeepsTheStateThatItIsMadeOf) {
  LightSetCache cache([](const FrameKey&, int, const MethodState*) { return someSet(); }, 1);
  auto state = std::make_shared<const MethodState>();
  const std::weak_ptr<const MethodState> watched = state;
  auto set = cache.get({}, 0, std::exchange(state, nullptr)).set;
  cache.get(FrameKey{.randomization = 1}, 0);  // the first is kept no more
  EXPECT_FALSE(watched.expired());
  set.reset();
  EXPECT_TRUE(watched.expired());
}

TEST(MethodStates, AreKeptByWhatTheirPagesHold) {
  int digested = 0;
  const MethodState* before = nullptr;
  const auto digest = [&](const StatePages&, const MethodState* last) {
    before = last;
    return ++digested, std::make_shared<const MethodState>();
  };
  const auto latest = std::make_shared<LatestState>();
  MethodStates states(digest, latest), edited(digest, latest);
  StatePages one, other;
  one.apply({{{0, 0}, Records(8, std::byte{1})}});
  other.apply({{{0, 0}, Records(8, std::byte{2})}});
  EXPECT_EQ(states.get(0, {}), nullptr);
  const auto first = states.get(1, one);
  EXPECT_EQ(states.get(1, one), first);
  EXPECT_NE(states.get(1, other), first) << "another master's version 1";
  EXPECT_EQ(digested, 2);
  EXPECT_EQ(before, first.get());

  // After an edit the first state goes on from the latest one of the client, however late that is.
  const auto last = latest->get();
  EXPECT_EQ(states.get(1, other), last);
  EXPECT_NE(edited.get(1, one), first);
  EXPECT_EQ(before, last.get());
}

}  // namespace
}  // namespace ninefold
