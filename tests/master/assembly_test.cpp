#include "master/assembly.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <random>

namespace ninefold {
namespace {

using std::chrono::seconds;

// Not a multiple of anything: small tasks at the border, and some without pixels.
const TileGrid kGrid(100, 67, {3, 2});

// What a client would send for a task: E tells frame, tile and phase.
ReceivedTile tileFor(uint32_t frame, int tile, int phase) {
  const TaskRect rect = kGrid.rect(tile, phase);
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

FrameKey keyOf(uint32_t frame) {
  FrameKey key;
  key.frame = frame;
  return key;
}

// Every pixel has a value of this frame's tasks.
void expectWhole(const FrameBuffer& buffer, uint32_t frame) {
  for (int phase = 0; phase < kGrid.interleave().sets(); ++phase)
    for (const float e : buffer.phase(phase).layers[0].irradiance.r)
      EXPECT_EQ(static_cast<int>(e * 1.01f) / 1000, static_cast<int>(frame) + 1);
}

class AssemblyTest : public testing::TestWithParam<int> {
 protected:
  Assembly::Answer answer = [this](ReceivedTile&&, const std::optional<std::string>& bad) {
    ++(bad ? malformed : good);
  };
  std::atomic<int> good = 0, malformed = 0;
  Assembly assembly{kGrid, kDiffuseBit, 0, GetParam(), answer};
  Time soon() const { return Clock::now() + seconds(30); }
};

INSTANTIATE_TEST_SUITE_P(Decoders, AssemblyTest, testing::Values(1, 3));

TEST_P(AssemblyTest, FramesLeaveWholeAndInOrderHoweverTheirTilesArrive) {
  std::mt19937 random(3);
  uint32_t opened = 0, done = 0;
  while (done < 9) {
    std::vector<ReceivedTile> tiles;
    for (; assembly.hasRoom(); ++opened) {
      assembly.open(keyOf(opened));
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
      expectWhole(*frame->buffer, done);
      assembly.release(*frame);
    }
  }
  EXPECT_EQ(malformed, 0);
}

TEST_P(AssemblyTest, OpensNoMoreFramesThanItHasBuffers) {
  for (uint32_t i = 0; i < Assembly::kBuffers; ++i) {
    ASSERT_TRUE(assembly.hasRoom());
    assembly.open(keyOf(i));
  }
  EXPECT_FALSE(assembly.hasRoom());
}

TEST_P(AssemblyTest, AMalformedTileIsAnsweredAndDoesNotKeepAGoodCopyOut) {
  assembly.open(keyOf(0));
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
  expectWhole(*frame->buffer, 0);
  EXPECT_EQ(malformed, static_cast<int>(tilesOf(0).size()));
}

TEST_P(AssemblyTest, TilesOfFramesThatAreNotOpenAreDropped) {
  assembly.open(keyOf(0));
  for (ReceivedTile& tile : tilesOf(5)) ASSERT_TRUE(assembly.take(tile));
  for (ReceivedTile& tile : tilesOf(0)) ASSERT_TRUE(assembly.take(tile));
  const auto frame = assembly.next(soon());
  ASSERT_TRUE(frame);
  expectWhole(*frame->buffer, 0);
}

}  // namespace
}  // namespace ninefold
