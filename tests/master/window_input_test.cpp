// What keys and pointer mean, without a window.
#include "master/interaction/window_input.h"

#include <gtest/gtest.h>

#include <set>

namespace ninefold {
namespace {

class WindowInputTest : public testing::Test {
 protected:
  using Event = WindowEvent::Kind;
  using Kind = Command::Kind;

  static Bounds room() {
    Bounds bounds;
    bounds.add(Vec3(-2)), bounds.add(Vec3(2));
    return bounds;
  }
  WindowEvent event(Event kind, Vec2 pointer = Vec2(0)) {
    WindowEvent e;
    e.kind = kind, e.time = now, e.pointer = pointer;
    return e;
  }
  std::vector<Command> send(const WindowEvent& e) { return input.take({e}, 480, camera); }
  std::vector<Command> press(int key, Modifiers modifiers = {}) {
    WindowEvent e = event(Event::keyDown);
    e.key = key, e.modifiers = modifiers;
    return send(e);
  }
  void release(int key) {
    WindowEvent e = event(Event::keyUp);
    e.key = key;
    send(e);
  }
  std::vector<Command> button(Button which, bool down, Vec2 at, Modifiers modifiers = {}) {
    WindowEvent e = event(down ? Event::buttonDown : Event::buttonUp, at);
    e.button = which, e.modifiers = modifiers;
    return send(e);
  }
  std::vector<Command> move(Vec2 to) { return send(event(Event::move, to)); }

  Time now = Time(std::chrono::hours(1));
  CameraControl camera{Camera(), room()};
  WindowInput input{now};
};

TEST_F(WindowInputTest, AKeyFliesForExactlyAsLongAsItIsHeld) {
  press('W');
  now += std::chrono::seconds(1);
  input.passTo(now, camera);
  now += std::chrono::milliseconds(500);
  release('W');
  now += std::chrono::seconds(9);
  input.passTo(now, camera);
  EXPECT_NEAR(camera.camera().eye.z, -1.5 * camera.speed(), 1e-5);
}

TEST_F(WindowInputTest, LosingTheKeyboardStopsTheFlight) {
  press('D');
  send(event(Event::focusLost));
  EXPECT_FALSE(camera.isFlying());
}

TEST_F(WindowInputTest, TheWheelChangesTheSpeedAndWithControlTheDistance) {
  const double speed = camera.speed();
  WindowEvent wheel = event(Event::scroll);
  wheel.notches = 2;
  send(wheel);
  EXPECT_NEAR(camera.speed(), speed * CameraControl::kSpeedStep * CameraControl::kSpeedStep, 1e-9);
  const Vec3 eye = camera.camera().eye;
  wheel.modifiers.control = true;
  send(wheel);
  EXPECT_NE(camera.camera().eye, eye);
}

TEST_F(WindowInputTest, EveryViewHasANumberKeyOfItsOwn) {
  std::multiset<PictureView> reached;
  for (const bool shift : {false, true})
    for (const char digit : std::string("1234567890")) {
      Modifiers modifiers;
      modifiers.shift = shift;
      for (const Command& command : press(digit, modifiers)) {
        ASSERT_EQ(command.kind, Kind::view);
        reached.insert(command.view);
        EXPECT_EQ(keyOf(command.view), (shift ? "Shift+" : "") + std::string(1, digit));
      }
    }
  for (size_t i = 0; i < kViewNames.size(); ++i)
    EXPECT_EQ(reached.count(static_cast<PictureView>(i)), 1u) << kViewNames[i];
}

TEST_F(WindowInputTest, ClickSelectsAndDragDoesNot) {
  button(Button::left, true, Vec2(100, 100));
  EXPECT_TRUE(move(Vec2(102, 101)).empty()) << "a hand trembles";
  const auto click = button(Button::left, false, Vec2(102, 101));
  ASSERT_EQ(click.size(), 1u);
  EXPECT_EQ(click[0].kind, Kind::select);

  button(Button::left, true, Vec2(100, 100));
  const auto drag = move(Vec2(130, 100));
  ASSERT_EQ(drag.size(), 2u);
  EXPECT_EQ(drag[0].kind, Kind::dragBegin);
  EXPECT_EQ(drag[0].pointer, Vec2(100, 100));
  EXPECT_EQ(drag[1].kind, Kind::drag);
  EXPECT_EQ(drag[1].mode, DragMode::ground);
  EXPECT_EQ(button(Button::left, false, Vec2(130, 100)).at(0).kind, Kind::dragEnd);
}

TEST_F(WindowInputTest, HeldKeysBindTheDrag) {
  press('X');
  button(Button::left, true, Vec2(0, 0));
  EXPECT_EQ(move(Vec2(50, 0)).at(0).mode, DragMode::alongX);
  release('X');
  EXPECT_EQ(move(Vec2(60, 0)).at(0).mode, DragMode::ground);
  button(Button::left, false, Vec2(60, 0));
  button(Button::left, true, Vec2(0, 0), {.control = true});
  EXPECT_EQ(move(Vec2(0, 50)).at(0).mode, DragMode::vertical);
}

TEST_F(WindowInputTest, ButtonsTurnTheCamera) {
  const Camera before = camera.camera();
  move(Vec2(100, 100));
  EXPECT_EQ(camera.camera(), before);
  button(Button::right, true, Vec2(100, 100));
  move(Vec2(200, 100));
  EXPECT_GT(camera.camera().forward.x, 0.1f) << "to the right";
  EXPECT_EQ(camera.camera().eye, before.eye);
  button(Button::right, false, Vec2(200, 100));
  const Camera looked = camera.camera();
  button(Button::middle, true, Vec2(200, 100));
  move(Vec2(250, 100));
  EXPECT_NE(camera.camera().eye, looked.eye);
}

TEST_F(WindowInputTest, KeysGiveTheirCommands) {
  EXPECT_EQ(press('3').at(0).kind, Kind::view);
  EXPECT_EQ(press('3').at(0).view, PictureView::normal);
  EXPECT_EQ(press(']').at(0).amount, WindowInput::kExposureStep);
  EXPECT_EQ(press('Z', {.control = true}).at(0).kind, Kind::undo);
  EXPECT_EQ(press('Z', {.shift = true, .control = true}).at(0).kind, Kind::redo);
  EXPECT_EQ(press('S', {.control = true}).at(0).kind, Kind::saveScene);
  EXPECT_FALSE(camera.isFlying()) << "Control+S saves and does not fly";
  EXPECT_EQ(press(key::kHome).at(0).kind, Kind::reset);
  EXPECT_EQ(press('V').at(0).kind, Kind::saveView);
  EXPECT_EQ(press(' ').at(0).kind, Kind::togglePlay);
  EXPECT_TRUE(press('J').empty());
}

}  // namespace
}  // namespace ninefold
