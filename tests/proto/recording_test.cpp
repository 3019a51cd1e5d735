// A recording is there once it is whole.
#include "proto/recording.h"

#include <gtest/gtest.h>

#include "tests/scene/temp_folder.h"

namespace ninefold {
namespace {

msg::Result result(uint32_t frame) {
  msg::Result r;
  r.frame = frame;
  return r;
}

TEST(Recording, IsWholeOnceItIsFinishedAndTheOldOneUntilThen) {
  const TempFolder folder;
  const auto file = folder.write("r", "old");
  Recorder recorder(file, msg::Hello{});
  for (uint32_t i = 0; i < 3; ++i) recorder.add(result(i));
  EXPECT_EQ(std::filesystem::file_size(file), 3u);
  recorder.finish();
  recorder.add(result(3));  // a worker that has not heard of the end
  recorder.finish();
  const std::vector<msg::Result> results = readRecording(file);
  ASSERT_EQ(results.size(), 3u);
  EXPECT_EQ(results[2].frame, 2u);
}

TEST(Recording, AFileThatCannotBeIsRefusedBeforeAnythingIsRendered) {
  const TempFolder folder;
  EXPECT_THROW(Recorder(folder.path() / "none" / "r", msg::Hello{}), Error);
  EXPECT_THROW(Recorder("/dev/null", msg::Hello{}), Error);
  EXPECT_THROW(Recorder(folder.path(), msg::Hello{}), Error);
}

}  // namespace
}  // namespace ninefold
