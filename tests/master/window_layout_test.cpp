// Where picture and panel lie, and what is remembered of it. A panel's column is 290 + 2 * 8 = 306
// wide.
#include "master/interaction/window_layout.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>

#include "tests/scene/temp_folder.h"

namespace ninefold {
namespace {

const ScreenSpace kLarge{1920, 1080, 1};

void expectArea(const WindowArea& area, Vec2 low, Vec2 high) {
  EXPECT_NEAR(area.low.x, low.x, 0.01f);
  EXPECT_NEAR(area.low.y, low.y, 0.01f);
  EXPECT_NEAR(area.high.x, high.x, 0.01f);
  EXPECT_NEAR(area.high.y, high.y, 0.01f);
}

TEST(WindowLayout, OpensWithThePictureBesideThePanel) {
  EXPECT_EQ(firstSize(640, 480, {}, kLarge), (WindowSize{306 + 640, 480}));
  EXPECT_EQ(firstSize(320, 240, {}, kLarge), (WindowSize{306 + 640, 480})) << "at least 480 high";
  EXPECT_EQ(firstSize(800, 600, {}, {}), (WindowSize{306 + 800, 600})) << "an unknown screen";
}

TEST(WindowLayout, OnAScreenThatIsTooSmallThePictureIsSmaller) {
  EXPECT_EQ(firstSize(3840, 2160, {}, kLarge).width, 1920);
  EXPECT_EQ(firstSize(640, 480, {}, {720, 480, 1}), (WindowSize{720, 480}));
  for (const WindowSize screen : {WindowSize{720, 480}, {1024, 600}, {1366, 768}, {300, 200}}) {
    const WindowSize size = firstSize(1600, 1200, {}, {screen.width, screen.height, 1});
    EXPECT_LE(size.width, screen.width);
    EXPECT_LE(size.height, screen.height);
  }
}

TEST(WindowLayout, EverythingGrowsWithTheScreensScale) {
  EXPECT_EQ(firstSize(640, 480, {}, {3840, 2160, 2}), (WindowSize{2 * (306 + 640), 960}));
}

TEST(WindowLayout, TheRememberedSizeIsTakenAsFarAsTheScreenGoes) {
  EXPECT_EQ(firstSize(640, 480, {1000, 700}, kLarge), (WindowSize{1000, 700}));
  EXPECT_EQ(firstSize(640, 480, {1000, 700}, {800, 600, 1}), (WindowSize{800, 600}));
}

TEST(WindowLayout, ThePictureIsAsLargeAsFitsBesideTheColumn) {
  expectArea(areaOfPicture({946, 480}, 306, {640, 480}), Vec2(306, 0), Vec2(946, 480));
  expectArea(areaOfPicture({946, 480}, 0, {640, 480}), Vec2(153, 0), Vec2(793, 480));
  // 414 are left: 414 x 310.5, in the middle of the height.
  expectArea(areaOfPicture({720, 480}, 306, {320, 240}), Vec2(306, 84.75f), Vec2(720, 395.25f));
  expectArea(areaOfPicture({400, 500}, 306, {400, 300}), Vec2(0, 100), Vec2(400, 400));
}

TEST(WindowMemory, ComesBackAsItWas) {
  for (const WindowMemory& memory : {WindowMemory{}, {1000, 700, true}, {1, 32768, false}})
    EXPECT_EQ(memoryOf(textOf(memory)), memory);
}

TEST(WindowMemory, WhatIsNoMemoryIsForgotten) {
  EXPECT_EQ(memoryOf(""), WindowMemory{});
  EXPECT_EQ(memoryOf("width x\nheight 5"), WindowMemory{});
  EXPECT_EQ(memoryOf("colour 7\nwidth -5\nheight 40000\nfolded 1\n"), (WindowMemory{0, 0, true}));
}

TEST(WindowMemory, LiesWhereTheUsersSettingsAre) {
  const auto file = [](std::map<std::string, std::string> variables) {
    return memoryFile([variables](const std::string& name) -> std::optional<std::string> {
      const auto found = variables.find(name);
      return found == variables.end() ? std::nullopt : std::optional(found->second);
    });
  };
  EXPECT_EQ(file({{"XDG_CONFIG_HOME", "/c"}, {"HOME", "/h"}}), "/c/ninefold/window");
  EXPECT_EQ(file({{"HOME", "/h"}}), "/h/.config/ninefold/window");
  EXPECT_EQ(file({{"XDG_CONFIG_HOME", "relative"}, {"HOME", "/h"}}), "/h/.config/ninefold/window");
  EXPECT_EQ(file({}), std::nullopt);
}

TEST(WindowMemory, AFileThatCannotBeIsNoReasonToFail) {
  const TempFolder folder;
  const auto file = folder.path() / "settings" / "ninefold" / "window";
  EXPECT_EQ(recall(file), WindowMemory{});
  remember({640, 480, true}, file);
  EXPECT_EQ(recall(file), (WindowMemory{640, 480, true}));
  std::ofstream(folder.path() / "file") << "no folder";
  remember({640, 480, true}, folder.path() / "file" / "ninefold" / "window");
  EXPECT_EQ(recall(folder.path() / "file" / "ninefold" / "window"), WindowMemory{});
}

}  // namespace
}  // namespace ninefold
