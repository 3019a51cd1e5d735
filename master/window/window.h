// window.h: a window with one picture and an immediate-mode panel over it. GLFW for window and
// events, OpenGL 3.3 and Dear ImGui for what is in it.
//
// The picture keeps its proportions. It is as large as fits beside the panel, or under it where
// less than half of the window would be left; its pixels are the screen's. What belongs to the
// panel makes no event: keys typed into it, and a press where the panel was last drawn (ImGui
// itself learns where the pointer is with its next frame only).
//
// Threads: the main thread, wake() excepted.   Owner: at most one at a time.
// Errors: the constructor throws NoDisplay with one line.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/base/error.h"
#include "common/image/tone_map.h"
#include "master/interaction/window_events.h"
#include "master/interaction/window_layout.h"

struct GLFWwindow;

namespace ninefold {

class NoDisplay : public Error {
 public:
  using Error::Error;
};

class Window {
 public:
  // Of the remembered size, else one at which a picture of that size and a panel fit, as far as the
  // screen goes.
  Window(const std::string& title, int pictureWidth, int pictureHeight, const WindowMemory& memory);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  void setTitle(const std::string& title);
  bool shouldClose() const;
  void close();
  // Until something happens, wake() is called, or the time is over.
  void wait(Duration most);
  static void wake();  // from any thread
  std::vector<WindowEvent> takeEvents();

  void setPicture(const DisplayImage& picture);  // from now on
  WindowArea pictureArea() const;
  void size(int& width, int& height) const;  // [screen units]

  // What is drawn with ImGui between the two is in the window afterwards; cover() tells where that
  // takes the pointer. The picture is drawn right of `column`.
  void beginFrame(float column);
  void cover(const WindowArea& area) { covered_.push_back(area); }
  void endFrame();

 private:
  static void onKey(GLFWwindow*, int key, int, int action, int modifiers);
  static void onText(GLFWwindow*, unsigned character);
  static void onButton(GLFWwindow*, int button, int action, int modifiers);
  static void onMove(GLFWwindow*, double x, double y);
  static void onScroll(GLFWwindow*, double, double y);
  static void onFocus(GLFWwindow*, int focused);
  static Window& of(GLFWwindow* window);
  void push(WindowEvent event, int modifiers);
  bool isCovered() const;

  GLFWwindow* window_ = nullptr;
  unsigned texture_ = 0;
  int width_ = 0, height_ = 0;  // of the picture; 0: none yet
  float column_ = 0;            // left of the picture [screen units]
  Vec2 pointer_{0};             // as of the latest event
  std::vector<WindowArea> covered_;
  bool popup_ = false;  // takes every press
  std::vector<WindowEvent> events_;
};

}  // namespace ninefold
