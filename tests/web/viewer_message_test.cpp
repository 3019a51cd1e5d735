// What browsers say.
#include "master/web/viewer_message.h"

#include <gtest/gtest.h>

#include "common/base/error.h"

namespace ninefold {
namespace {

template <typename What>
What read(const std::string& line) {
  return std::get<What>(parseViewerMessage(line));
}

WindowEvent event(const std::string& line) { return read<said::Event>(line).event; }

TEST(ViewerMessage, SaysWhatAWindowsEventsSay) {
  const WindowEvent press = event("button down middle 12.5 -3 sa");
  EXPECT_EQ(press.kind, WindowEvent::Kind::buttonDown);
  EXPECT_EQ(press.button, Button::middle);
  EXPECT_EQ(press.pointer, Vec2(12.5f, -3));
  EXPECT_TRUE(press.modifiers.shift && press.modifiers.alt && !press.modifiers.control);
  EXPECT_EQ(event("button up right 0 0 -").kind, WindowEvent::Kind::buttonUp);

  const WindowEvent wheel = event("scroll 1 2 -1.5 c");
  EXPECT_EQ(wheel.kind, WindowEvent::Kind::scroll);
  EXPECT_EQ(wheel.notches, -1.5f);
  EXPECT_TRUE(wheel.modifiers.control);

  EXPECT_EQ(event("move 100000 7 -").pointer, Vec2(100000, 7));
  EXPECT_EQ(event("key down 87 -").key, 'W');
  EXPECT_EQ(event("key down 87 -").kind, WindowEvent::Kind::keyDown);
  EXPECT_EQ(event("key up 340 s").kind, WindowEvent::Kind::keyUp);
  EXPECT_EQ(event("blur").kind, WindowEvent::Kind::focusLost);
}

TEST(ViewerMessage, SaysTheRest) {
  EXPECT_EQ(read<said::Hello>("hello").token, "");
  EXPECT_EQ(read<said::Hello>("hello abc").token, "abc");
  EXPECT_EQ(read<said::Size>("size 640.5 480").size, Vec2(640.5f, 480));
  EXPECT_EQ(read<said::View>("view indirect").view, PictureView::indirect);
  EXPECT_EQ(read<said::Exposure>("exposure -2.5").ev, -2.5f);
  EXPECT_EQ(read<said::Exposure>("exposure auto").ev, std::nullopt);
  EXPECT_EQ(read<said::Lamp>("lamp 3").number, 3u);
  EXPECT_EQ(read<said::GoTo>("camera 0").camera, 0u);
  EXPECT_EQ(read<said::Download>("download exr").kind, said::Download::Kind::exr);
  EXPECT_EQ(read<said::Download>("download png").kind, said::Download::Kind::png);
  read<said::Shown>("shown");
  read<said::Ask>("ask");
  read<said::Give>("give");
}

TEST(ViewerMessage, RefusesEverythingElseInOneLine) {
  for (const std::string line : {"",
                                 " ",
                                 "fly",
                                 "Shown",
                                 "shown 1",
                                 "hello a b",
                                 "size 0 5",
                                 "size 5",
                                 "size 1e6 1",
                                 "size nan 1",
                                 "size inf 1",
                                 "key down",
                                 "key down -1 -",
                                 "key down 1024 -",
                                 "key over 5 -",
                                 "key down 5",
                                 "key down 5 x",
                                 "key down 5 cs",
                                 "key down 5 ss",
                                 "button down left 1 -",
                                 "button down thumb 1 1 -",
                                 "move 1 1",
                                 "move 1 100001 -",
                                 "move 1 nan -",
                                 "move 0x1 1 -",
                                 "move 1,5 1 -",
                                 "scroll 1 1 101 -",
                                 "scroll 1 1 -",
                                 "view",
                                 "view beautiful",
                                 "exposure",
                                 "exposure 51",
                                 "exposure autos",
                                 "lamp -1",
                                 "lamp 1000001",
                                 "lamp 1.5",
                                 "camera 99999999999",
                                 "download hdr",
                                 "download",
                                 "move  1 1 -",
                                 "move\t1 1 -"}) {
    try {
      parseViewerMessage(line);
      ADD_FAILURE() << "taken: " << line;
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << line;
    }
  }
}

TEST(ViewerMessage, IsNoLongerThanItsLimit) {
  const std::string hello = "hello ";
  EXPECT_NO_THROW(
      parseViewerMessage(hello + std::string(kLongestViewerMessage - hello.size(), 'x')));
  EXPECT_THROW(
      parseViewerMessage(hello + std::string(kLongestViewerMessage - hello.size() + 1, 'x')),
      Error);
}

TEST(ViewerMessage, RepeatsNothingThatCouldBeAToken) {
  for (const std::string line : {"hello secret secret", "secret", "view secret", "key secret 1 -"})
    try {
      parseViewerMessage(line);
      ADD_FAILURE() << line;
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()).find("secret"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace ninefold
