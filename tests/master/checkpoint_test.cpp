// Checkpoint files: what was kept comes back, bit for bit, and nothing else is taken for one.
#include "master/output/checkpoint.h"

#include <gtest/gtest.h>

#include "master/assembly/picture.h"
#include "tests/scene/temp_folder.h"

namespace ninefold {
namespace {

const Checkpoint::Rows kJob{{"release", "1"}, {"seed", "7"}};
constexpr CheckpointLimits kLimits{5000, true};

Checkpoint example() {
  Checkpoint c;
  c.job = kJob;
  c.pixelClass = "abcd", c.isa = "avx2", c.reproducible = false;
  c.frames = 12, c.seconds = 3.25, c.state = 4;
  c.pages.apply({{{1, 0}, Records(100, std::byte{3})}, {{2, 5}, std::vector<SumChange>{{9, -4}}}});
  for (int i = 0; i < 4000; ++i) c.film.push_back(static_cast<std::byte>(i * i));
  return c;
}

// The one line that the bytes are refused by; "" if they are taken.
std::string complaint(ByteView bytes, const Checkpoint::Rows& job = kJob,
                      const CheckpointLimits& limits = kLimits) {
  try {
    decodeCheckpoint(bytes, job, limits);
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(Checkpoint, ComesBackAsItWas) {
  const Checkpoint a = example(), b = decodeCheckpoint(encodeCheckpoint(a), kJob, kLimits);
  EXPECT_EQ(b.job, a.job);
  EXPECT_EQ(b.pixelClass, a.pixelClass);
  EXPECT_EQ(b.isa, a.isa);
  EXPECT_EQ(b.reproducible, a.reproducible);
  EXPECT_EQ(b.frames, a.frames);
  EXPECT_EQ(b.seconds, a.seconds);
  EXPECT_EQ(b.state, a.state);
  EXPECT_EQ(b.pages.hash(), a.pages.hash());
  EXPECT_EQ(b.film, a.film);
}

TEST(Checkpoint, AnotherJobIsToldApart) {
  const Bytes bytes = encodeCheckpoint(example());
  EXPECT_NE(complaint(bytes, {{"release", "1"}, {"seed", "8"}}).find("seed is 7 there, 8 here"),
            std::string::npos);
  EXPECT_NE(complaint(bytes, {{"release", "1"}}).find("another job"), std::string::npos);
  EXPECT_NE(complaint(bytes, kJob, {3999, true}).find("at most 3999"), std::string::npos);
  EXPECT_NE(complaint(bytes, kJob, {5000, false}), "");
}

TEST(Checkpoint, EveryByteCounts) {
  const Bytes bytes = encodeCheckpoint(example());
  for (size_t i = 0; i < bytes.size(); ++i) {
    Bytes spoilt = bytes;
    spoilt[i] ^= std::byte{1};
    EXPECT_NE(complaint(spoilt), "") << "byte " << i;
    EXPECT_NE(complaint(ByteView(bytes).first(i)), "") << "cut at " << i;
  }
}

TEST(Checkpoint, ImpossibleNumbersAreRefused) {
  for (const int64_t frames : {int64_t{0}, int64_t{-1}, int64_t{1} << 40}) {
    Checkpoint c = example();
    c.frames = frames;
    EXPECT_NE(complaint(encodeCheckpoint(c)).find("frames"), std::string::npos);
  }
  Checkpoint c = example();
  c.seconds = -1;
  EXPECT_NE(complaint(encodeCheckpoint(c)), "");
}

TEST(Checkpoint, NoFileIsNoneAndAFolderIsAnError) {
  const TempFolder folder;
  EXPECT_FALSE(readCheckpoint((folder.path() / "none").string(), kJob, kLimits).has_value());
  EXPECT_THROW(readCheckpoint(folder.path().string(), kJob, kLimits), Error);
  const std::string file = (folder.path() / "c").string();
  writeCheckpoint(file, example());
  EXPECT_EQ(readCheckpoint(file, kJob, kLimits)->film, example().film);
}

// --- the film in it ---

PictureMaker::Setup smallPicture() {
  PictureMaker::Setup setup;
  setup.shape = {TileGrid(40, 24, {1, 1}), kRadianceMask, 0};
  setup.keeps = {.error = true, .twoRadii = true};
  return setup;
}

TEST(KeptFilm, AFilmThatIsPutBackKeepsTheSameBytes) {
  const PictureMaker empty(smallPicture());
  Bytes kept, again;
  empty.keep(kept);
  EXPECT_LE(kept.size(), empty.keptBytes());
  PictureMaker other(smallPicture());
  other.restore(kept, 0);
  other.keep(again);
  EXPECT_EQ(kept, again);
}

TEST(KeptFilm, WhatIsNoFilmOfThisPictureIsRefused) {
  PictureMaker picture(smallPicture());
  Bytes kept;
  picture.keep(kept);
  EXPECT_THROW(picture.restore(kept, 1), Error) << "another number of frames";
  EXPECT_THROW(picture.restore(ByteView(kept).first(kept.size() - 1), 0), Error);
  Bytes longer = kept;
  longer.push_back(std::byte{0});
  EXPECT_THROW(picture.restore(longer, 0), Error);
  Bytes spoilt = kept;
  for (size_t i = 8; i < 16; ++i) spoilt[i] = std::byte{0xff};  // the first mean: NaN
  EXPECT_THROW(picture.restore(spoilt, 0), Error);
}

}  // namespace
}  // namespace ninefold
