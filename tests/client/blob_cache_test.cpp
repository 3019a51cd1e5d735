#include "client/blob_cache.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <random>

#include "common/base/error.h"
#include "proto/scene_blobs.h"

namespace ninefold {
namespace {

namespace fs = std::filesystem;

class BlobCacheTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "ninefold-cache-XXXXXX").string();
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    base = pattern;
    // Real blobs: one for each image of a scene, of incompressible texels.
    std::mt19937 random(7);
    Scene scene;
    for (int i = 0; i < 4; ++i) {
      TextureImage image;
      image.width = image.height = 64;
      image.texels.resize(64 * 64 * 4);
      for (uint8_t& texel : image.texels) texel = static_cast<uint8_t>(random());
      scene.images.push_back(std::move(image));
    }
    blobs = packScene(scene);
    ASSERT_GE(blobs.size(), 4u);
  }
  void TearDown() override { fs::remove_all(base); }

  Bytes rawOf(const Blob& blob) const { return unpackBlob(blob.info, blob.compressed); }
  fs::path folder() const { return base / "cache"; }
  fs::path fileOf(const Blob& blob) const { return folder() / hex(blob.info.hash); }

  fs::path base;
  std::vector<Blob> blobs;
};

TEST_F(BlobCacheTest, GivesBackWhatItKeptAlsoInTheNextRun) {
  BlobCache(folder()).store(blobs[0].info, blobs[0].compressed);
  BlobCache next(folder());
  EXPECT_EQ(next.load(blobs[0].info), rawOf(blobs[0]));
  EXPECT_EQ(next.load(blobs[1].info), std::nullopt);
}

TEST_F(BlobCacheTest, IsPrivate) {
  BlobCache cache(folder());
  cache.store(blobs[0].info, blobs[0].compressed);
  struct stat status {};
  ASSERT_EQ(::stat(folder().c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0700u);
  ASSERT_EQ(::stat(fileOf(blobs[0]).c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600u);
}

TEST_F(BlobCacheTest, RefusesAFolderThatOthersMayEnter) {
  fs::create_directory(folder());
  fs::permissions(folder(), fs::perms(0755));
  EXPECT_THROW(BlobCache{folder()}, Error);
}

TEST_F(BlobCacheTest, RefusesAFile) {
  std::ofstream(base / "file") << "text";
  EXPECT_THROW(BlobCache{base / "file"}, Error);
}

TEST_F(BlobCacheTest, DeletesDamagedEntriesAndCallsThemAbsent) {
  BlobCache cache(folder());
  const auto damage = [&](const Blob& blob, auto how) {
    cache.store(blob.info, blob.compressed);
    how(fileOf(blob));
    EXPECT_EQ(cache.load(blob.info), std::nullopt);
    EXPECT_FALSE(fs::exists(fileOf(blob)));
  };
  damage(blobs[0], [](const fs::path& file) { fs::resize_file(file, fs::file_size(file) / 2); });
  damage(blobs[0], [](const fs::path& file) { fs::resize_file(file, 0); });
  damage(blobs[0], [](const fs::path& file) { std::ofstream(file) << "something else"; });
  damage(blobs[0], [&](const fs::path& file) {  // a whole blob, but of another name
    fs::remove(file);
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(blobs[1].compressed.data()),
               static_cast<std::streamsize>(blobs[1].compressed.size()));
  });
  cache.store(blobs[0].info, blobs[0].compressed);
  EXPECT_TRUE(cache.load(blobs[0].info)) << "fetched again, kept again";
}

TEST_F(BlobCacheTest, FollowsNoLinkOutOfItsFolder) {
  BlobCache cache(folder());
  const fs::path outside = base / "outside";
  std::ofstream(outside) << "private";
  fs::create_symlink(outside, fileOf(blobs[0]));
  EXPECT_EQ(cache.load(blobs[0].info), std::nullopt);
  EXPECT_TRUE(fs::exists(outside));
  cache.store(blobs[0].info, blobs[0].compressed);
  EXPECT_EQ(fs::file_size(outside), 7u);
  EXPECT_TRUE(cache.load(blobs[0].info));
}

TEST_F(BlobCacheTest, StaysWithinItsBoundByForgettingWhatWasUsedLongestAgo) {
  const uint64_t one = blobs[0].compressed.size();
  BlobCache cache(folder(), one * 5 / 2);
  const auto age = [&](const Blob& blob, int hours) {
    fs::last_write_time(fileOf(blob), fs::file_time_type::clock::now() - std::chrono::hours(hours));
  };
  cache.store(blobs[0].info, blobs[0].compressed);
  age(blobs[0], 3);
  cache.store(blobs[1].info, blobs[1].compressed);
  age(blobs[1], 2);
  EXPECT_TRUE(cache.load(blobs[0].info));  // used again: now blob 1 is the oldest
  cache.store(blobs[2].info, blobs[2].compressed);
  EXPECT_TRUE(fs::exists(fileOf(blobs[0])));
  EXPECT_FALSE(fs::exists(fileOf(blobs[1])));
  EXPECT_TRUE(fs::exists(fileOf(blobs[2])));
}

// A folder that was taken away stands for a disk that is full or read-only.
TEST_F(BlobCacheTest, AFolderThatTakesNothingIsToldOnceAndHarmsNothing) {
  BlobCache cache(folder());
  fs::remove_all(folder());
  testing::internal::CaptureStderr();
  for (const Blob& blob : blobs) cache.store(blob.info, blob.compressed);
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_EQ(std::ranges::count(said, '\n'), 1) << said;
  EXPECT_NE(said.find("going on"), std::string::npos) << said;
  EXPECT_EQ(cache.load(blobs[0].info), std::nullopt);
}

TEST_F(BlobCacheTest, ReplacesALinkInsteadOfFollowingIt) {
  BlobCache cache(folder());
  std::ofstream(base / "outside") << "private";
  fs::create_symlink(base / "outside", fileOf(blobs[0]));
  cache.store(blobs[0].info, blobs[0].compressed);
  EXPECT_EQ(fs::file_size(base / "outside"), 7u);
  EXPECT_TRUE(cache.load(blobs[0].info));
}

TEST_F(BlobCacheTest, DoesNotKeepWhatIsLargerThanItsBound) {
  BlobCache cache(folder(), 100);
  cache.store(blobs[0].info, blobs[0].compressed);
  EXPECT_TRUE(fs::is_empty(folder()));
}

}  // namespace
}  // namespace ninefold
