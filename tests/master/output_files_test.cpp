// The files of a run are looked at before it begins.
#include "master/output/output_files.h"

#include <gtest/gtest.h>

#include "common/base/error.h"
#include "master/options/numbered_name.h"
#include "tests/scene/temp_folder.h"

namespace ninefold {
namespace {

TEST(OutputFiles, TheLastRunOfSignsInTheNameIsTheNumber) {
  EXPECT_EQ(numbered("out.####.png", 7), "out.0007.png");
  EXPECT_EQ(numbered("#.png", 12), "12.png");
  EXPECT_EQ(numbered("take#2/out.##.png", 7), "take#2/out.07.png");
  EXPECT_EQ(numbered("shot#1.###.exr", 7), "shot#1.007.exr");
  EXPECT_TRUE(isNumbered("a#.png"));
  EXPECT_FALSE(isNumbered("a.png"));
  EXPECT_FALSE(isNumbered("take#2/a.png"));
}

TEST(OutputFiles, EachIsCheckedBeforeTheRun) {
  const TempFolder folder;
  const auto in = [&](const char* name) { return (folder.path() / name).string(); };
  Options options;
  options.output = in("a.png"), options.stats = in("s.json");
  EXPECT_NO_THROW(checkFiles(options));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  options.stats = in("none/s.json");
  EXPECT_THROW(checkFiles(options), Error);
  options.stats = "/dev/null";
  EXPECT_THROW(checkFiles(options), Error);
  options.stats = "-";
  EXPECT_NO_THROW(checkFiles(options));
  options.output = in("none/a.png");
  EXPECT_THROW(checkFiles(options), Error);
}

TEST(OutputFiles, ASeriesIsCheckedByItsFirstPicture) {
  const TempFolder folder;
  Options options;
  options.animate = AnimationRange{0, 1, 25};
  options.output = (folder.path() / "o.##.png").string();
  EXPECT_NO_THROW(checkFiles(options));
  std::filesystem::create_directory(folder.path() / "o.00.png");
  EXPECT_THROW(checkFiles(options), Error);
}

}  // namespace
}  // namespace ninefold
