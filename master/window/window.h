// window.h: a window with one picture and an immediate-mode panel over it. GLFW for window and
// events, OpenGL 3.3 and Dear ImGui for what is in it.
//
// The picture keeps its proportions and is as large as fits; the window's pixel density is the
// screen's. What ImGui wants for itself (a click on the panel, typing into it) makes no event.
//
// Threads: the main thread, wake() excepted. Owner: at most one at a time.
// Errors: the constructor throws NoDisplay with one line.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/base/error.h"
#include "common/image/tone_map.h"
#include "master/window_events.h"

struct GLFWwindow;

namespace ninefold {

class NoDisplay : public Error {
 public:
  using Error::Error;
};

// A rectangle of the window [screen units].
struct WindowArea {
  Vec2 low{0}, high{0};
  // As shares of its width and height, y downwards.
  Vec2 share(Vec2 p) const { return (p - low) / (high - low); }
  bool contains(Vec2 p) const {
    return p.x >= low.x && p.x < high.x && p.y >= low.y && p.y < high.y;
  }
};

class Window {
 public:
  Window(const std::string& title, int width, int height);
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

  // What is drawn with ImGui between the two is in the window afterwards.
  void beginFrame();
  void endFrame();

 private:
  static void onKey(GLFWwindow*, int key, int, int action, int modifiers);
  static void onButton(GLFWwindow*, int button, int action, int modifiers);
  static void onMove(GLFWwindow*, double x, double y);
  static void onScroll(GLFWwindow*, double, double y);
  static void onFocus(GLFWwindow*, int focused);
  static Window& of(GLFWwindow* window);
  void push(WindowEvent event, int modifiers);

  GLFWwindow* window_ = nullptr;
  unsigned texture_ = 0;
  int width_ = 0, height_ = 0;  // of the picture; 0: none yet
  std::vector<WindowEvent> events_;
};

}  // namespace ninefold
