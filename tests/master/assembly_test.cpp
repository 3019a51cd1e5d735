#include "master/assembly/assembly.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <random>
#include <set>

namespace ninefold {
namespace {

using std::chrono::seconds;

// Not a multiple of anything: small tasks at the border, and some without pixels.
const TileGrid kGrid(100, 67, {3, 2});

// What a client would send for a task: E tells frame, tile and phase.
ReceivedTile tileFor(uint32_t frame, int tile, int phase, const TileGrid& grid = kGrid) {
  const TaskRect rect = grid.rect(tile, phase);
  TileResult planes;
  planes.reset(rect.width, rect.height, kDiffuseBit, 0);
  const float value = static_cast<float>(1000 * (frame + 1) + 10 * static_cast<uint32_t>(tile) +
                                         static_cast<uint32_t>(phase));
  std::ranges::fill(planes.layers[0].irradiance.r, value);
  TileEncoder encoder;
  ReceivedTile received;
  received.client = 1;
  received.result.frame = frame;
  received.result.tile = static_cast<uint32_t>(tile);
  received.result.phase = static_cast<uint32_t>(phase);
  received.result.encoded = encoder.encode(planes, 7, 1).bytes;
  return received;
}

std::vector<ReceivedTile> tilesOf(uint32_t frame) {
  std::vector<ReceivedTile> tiles;
  for (int tile = 0; tile < kGrid.tiles(); ++tile)
    for (int phase = 0; phase < kGrid.interleave().sets(); ++phase)
      if (kGrid.rect(tile, phase).count() > 0) tiles.push_back(tileFor(frame, tile, phase));
  return tiles;
}

FrameView viewOf(uint32_t frame, const TileGrid& grid = kGrid) {
  FrameView view{{}, {grid, kDiffuseBit, 0}, {}, 1};
  view.key.frame = frame;
  return view;
}

class AssemblyTest : public testing::TestWithParam<int> {
 protected:
  // Every pixel of the tile and around it has a value of this frame's tasks.
  void check(const GatheredFrame& frame, int tile) {
    const int number = static_cast<int>(frame.view.key.frame);
    if (number != finishing) finished.clear(), finishing = number;
    TileResult planes;
    forEachAround(kGrid, tile, 1, [&](int around) {
      for (int phase = 0; phase < kGrid.interleave().sets(); ++phase) {
        const UnpackedTile& task = frame.task(around, phase);
        const TaskRect rect = kGrid.rect(around, phase);
        EXPECT_EQ(task.width(), rect.width);
        planes.reset(rect.width, rect.height, kDiffuseBit, 0);
        task.copy({0, 0, 0, rect.width, rect.height}, kDiffuseBit, kDiffuseBit, rect.width, planes);
        for (const float e : planes.layers[0].irradiance.r)
          EXPECT_EQ(static_cast<int>(e * 1.01f) / 1000, number + 1);
      }
    });
    EXPECT_TRUE(finished.insert(tile).second) << "finished twice";
  }
  void expectWhole(const Assembly::Complete& frame) {
    const std::lock_guard lock(mutex);
    EXPECT_EQ(finishing, static_cast<int>(frame.key.frame));
    EXPECT_EQ(static_cast<int>(finished.size()), kGrid.tiles());
  }

  std::mutex mutex;
  int finishing = -1;      // guarded by mutex: the frame that tiles came from last
  std::set<int> finished;  // guarded by mutex: its tiles
  std::atomic<int> good = 0, malformed = 0;
  Assembly::Answer answer = [this](ReceivedTile&&, const std::optional<std::string>& bad) {
    ++(bad ? malformed : good);
  };
  Assembly::Finish finish = [this](int, const GatheredFrame& frame, int tile) {
    const std::lock_guard lock(mutex);
    check(frame, tile);
  };
  Assembly assembly{GetParam(), answer, finish};
  Time soon() const { return Clock::now() + seconds(30); }
};

INSTANTIATE_TEST_SUITE_P(Workers, AssemblyTest, testing::Values(1, 3));

TEST_P(AssemblyTest, FramesLeaveWholeAndInOrderHoweverTheirTilesArrive) {
  std::mt19937 random(3);
  uint32_t opened = 0, done = 0;
  while (done < 9) {
    std::vector<ReceivedTile> tiles;
    for (; assembly.hasRoom(); ++opened) {
      assembly.open(viewOf(opened));
      for (ReceivedTile& tile : tilesOf(opened)) tiles.push_back(std::move(tile));
    }
    std::ranges::shuffle(tiles, random);
    for (ReceivedTile& tile : tiles) {
      ReceivedTile copy = tile;
      ASSERT_TRUE(assembly.take(tile));
      if (random() % 4 == 0) {
        ASSERT_TRUE(assembly.take(copy));
      }
    }
    for (; done < opened; ++done) {
      const auto frame = assembly.next(soon());
      ASSERT_TRUE(frame);
      EXPECT_EQ(frame->key.frame, done);
      expectWhole(*frame);
      assembly.release(*frame);
    }
  }
  EXPECT_EQ(malformed, 0);
}

class Room {
 public:
  explicit Room(const TileGrid& grid) : grid_(grid) {}

  int fill() {
    int opened = 0;
    for (; assembly_.hasRoom(); ++opened) assembly_.open(viewOf(next_++, grid_));
    return opened;
  }
  // Frame 0 comes whole. Gives back the bytes of its results.
  size_t finishFirst() {
    size_t bytes = 0;
    for (int tile = 0; tile < grid_.tiles(); ++tile)
      for (int phase = 0; phase < grid_.interleave().sets(); ++phase) {
        const TaskRect rect = grid_.rect(tile, phase);
        if (rect.count() == 0) continue;
        ReceivedTile received = tileFor(0, tile, phase, grid_);
        bytes +=
            TileDecoder()
                .unpack(Bytes(received.result.encoded), {rect.width, rect.height, kDiffuseBit, 0})
                .bytes();
        EXPECT_TRUE(assembly_.take(received));
      }
    const auto first = assembly_.next(Clock::now() + seconds(60));
    EXPECT_TRUE(first);
    assembly_.release(*first);
    return bytes;
  }

 private:
  const TileGrid grid_;
  uint32_t next_ = 0;
  Assembly assembly_{2, [](ReceivedTile&&, const auto&) {}, [](int, const auto&, int) {}};
};

TEST(AssemblyRoom, TwoFramesMayBeOpenBeforeItIsKnownWhatOneBrings) {
  Room room(kGrid);
  EXPECT_EQ(room.fill(), Assembly::kLeastFrames);
  room.finishFirst();
  EXPECT_EQ(room.fill(), Assembly::kMostFrames - 1);
}

TEST(AssemblyRoom, OpenFramesTogetherBringNoMoreThanMayWait) {
  Room room(TileGrid(4000, 3000, {1, 1}));
  room.fill();
  const auto fit = static_cast<int>(Assembly::kMostBytes / room.finishFirst());
  ASSERT_LT(fit, Assembly::kMostFrames);
  EXPECT_EQ(room.fill(), fit - 1) << "one is open still";
}

TEST_P(AssemblyTest, WhatIsSupersededLeavesRoom) {
  for (uint32_t i = 0; i < Assembly::kLeastFrames; ++i) assembly.open(viewOf(i));
  EXPECT_FALSE(assembly.hasRoom());
  assembly.supersede(1);
  EXPECT_TRUE(assembly.hasRoom());
}

TEST_P(AssemblyTest, ASupersededFrameIsNotWaitedFor) {
  for (uint32_t i = 0; i < 3; ++i) assembly.open(viewOf(i));
  std::vector<ReceivedTile> first = tilesOf(0);
  for (size_t i = 0; i < first.size() / 2; ++i) ASSERT_TRUE(assembly.take(first[i]));
  for (ReceivedTile& tile : tilesOf(2)) ASSERT_TRUE(assembly.take(tile));
  EXPECT_FALSE(assembly.next(Clock::now()));
  assembly.supersede(2);
  const auto frame = assembly.next(soon());
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->key.frame, 2u);
  expectWhole(*frame);
}

// Somebody looks at a frame while it is superseded: it stays, and the next one waits.
TEST_P(AssemblyTest, AFrameThatIsLookedAtStaysUntilItIsReleased) {
  for (uint32_t i = 0; i < 3; ++i) assembly.open(viewOf(i));
  for (ReceivedTile& tile : tilesOf(0)) ASSERT_TRUE(assembly.take(tile));
  const auto held = assembly.next(soon());
  ASSERT_TRUE(held);
  assembly.supersede(2);
  for (ReceivedTile& tile : tilesOf(2)) ASSERT_TRUE(assembly.take(tile));
  expectWhole(*held);
  assembly.release(*held);
  const auto frame = assembly.next(soon());
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->key.frame, 2u);
  expectWhole(*frame);
}

TEST_P(AssemblyTest, AMalformedTileIsAnsweredAndDoesNotKeepAGoodCopyOut) {
  assembly.open(viewOf(0));
  std::vector<ReceivedTile> tiles = tilesOf(0);
  for (size_t i = 0; i < tiles.size(); ++i) {
    ReceivedTile broken = tiles[i];
    broken.result.encoded.resize(broken.result.encoded.size() / 2);
    ASSERT_TRUE(assembly.take(broken));
  }
  EXPECT_FALSE(assembly.next(Clock::now()));
  for (ReceivedTile& tile : tiles) ASSERT_TRUE(assembly.take(tile));
  const auto frame = assembly.next(soon());
  ASSERT_TRUE(frame);
  expectWhole(*frame);
  EXPECT_EQ(malformed, static_cast<int>(tilesOf(0).size()));
}

TEST_P(AssemblyTest, TilesOfFramesThatAreNotOpenAreDropped) {
  assembly.open(viewOf(0));
  for (ReceivedTile& tile : tilesOf(5)) ASSERT_TRUE(assembly.take(tile));
  for (ReceivedTile& tile : tilesOf(0)) ASSERT_TRUE(assembly.take(tile));
  const auto frame = assembly.next(soon());
  ASSERT_TRUE(frame);
  expectWhole(*frame);
}

}  // namespace
}  // namespace ninefold
