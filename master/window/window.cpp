#include "master/window/window.h"

// clang-format off: GLFW brings OpenGL's own header along
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>
// clang-format on

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace ninefold {
namespace {

constexpr float kFontSize = 15;  // [screen units]

[[noreturn]] void failWithoutDisplay() {
  const char* description = nullptr;
  glfwGetError(&description);
  glfwTerminate();
  throw NoDisplay(fmt::format("no window can be opened: {}",
                              description != nullptr ? description : "no display is there"));
}

// Whether there may be a display. GLFW is not asked without one: Wayland's library would print
// lines of its own.
bool mayHaveDisplay() {
  const auto isSet = [](const char* name) { return std::getenv(name) != nullptr; };
  return isSet("DISPLAY") || isSet("WAYLAND_DISPLAY") || isSet("XDG_RUNTIME_DIR");
}

ScreenSpace screen() {
  ScreenSpace space;
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  if (monitor == nullptr) return space;
  int x = 0, y = 0;
  float scaleY = 1;
  glfwGetMonitorWorkarea(monitor, &x, &y, &space.width, &space.height);
  glfwGetMonitorContentScale(monitor, &space.scale, &scaleY);
  return space;
}

void setUpStyle(GLFWwindow* window) {
  float scaleX = 1, scaleY = 1;
  glfwGetWindowContentScale(window, &scaleX, &scaleY);
  ImGui::StyleColorsDark();
  ImGui::GetStyle().ScaleAllSizes(scaleX);
  ImGui::GetStyle().WindowRounding = 4;
  ImFontConfig font;
  font.SizePixels = kFontSize * scaleX;
  ImGui::GetIO().Fonts->AddFontDefault(&font);
  ImGui::GetIO().IniFilename = nullptr;  // see window_memory.h
}

}  // namespace

Window::Window(const std::string& title, int pictureWidth, int pictureHeight,
               const WindowMemory& memory) {
  if (!mayHaveDisplay() || glfwInit() != GLFW_TRUE) failWithoutDisplay();
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  const WindowSize size = firstSize(pictureWidth, pictureHeight, memory, screen());
  window_ = glfwCreateWindow(size.width, size.height, title.c_str(), nullptr, nullptr);
  if (window_ == nullptr) failWithoutDisplay();
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(1);
  glfwSetWindowUserPointer(window_, this);
  glfwSetKeyCallback(window_, onKey);
  glfwSetMouseButtonCallback(window_, onButton);
  glfwSetCursorPosCallback(window_, onMove);
  glfwSetScrollCallback(window_, onScroll);
  glfwSetCharCallback(window_, onText);
  glfwSetWindowFocusCallback(window_, onFocus);
  double x = 0, y = 0;
  glfwGetCursorPos(window_, &x, &y);
  pointer_ = Vec2(static_cast<float>(x), static_cast<float>(y));
  ImGui::CreateContext();
  setUpStyle(window_);
  ImGui_ImplGlfw_InitForOpenGL(window_, true);  // calls ours after its own
  ImGui_ImplOpenGL3_Init("#version 330 core");
  glGenTextures(1, &texture_);
}

Window::~Window() {
  glDeleteTextures(1, &texture_);
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
  glfwDestroyWindow(window_);
  glfwTerminate();
}

void Window::setTitle(const std::string& title) { glfwSetWindowTitle(window_, title.c_str()); }
bool Window::shouldClose() const { return glfwWindowShouldClose(window_) != 0; }
void Window::close() { glfwSetWindowShouldClose(window_, GLFW_TRUE); }
void Window::wait(Duration most) { glfwWaitEventsTimeout(std::max(1e-4, seconds(most))); }
void Window::wake() { glfwPostEmptyEvent(); }
std::vector<WindowEvent> Window::takeEvents() { return std::exchange(events_, {}); }

Window& Window::of(GLFWwindow* window) {
  return *static_cast<Window*>(glfwGetWindowUserPointer(window));
}

void Window::push(WindowEvent event, int modifiers) {
  event.pointer = pointer_;  // not where it is by now
  event.time = Clock::now();
  event.modifiers = {(modifiers & GLFW_MOD_SHIFT) != 0, (modifiers & GLFW_MOD_CONTROL) != 0,
                     (modifiers & GLFW_MOD_ALT) != 0};
  events_.push_back(event);
}

bool Window::isCovered() const {
  return popup_ || std::ranges::any_of(covered_, [this](const WindowArea& area) {
           return area.contains(pointer_);
         });
}

// What begins on the panel is the panel's; what ends is told always, so that nothing stays held.
void Window::onKey(GLFWwindow* window, int key, int, int action, int modifiers) {
  if (action == GLFW_REPEAT || (action == GLFW_PRESS && ImGui::GetIO().WantCaptureKeyboard)) return;
  WindowEvent event;
  event.kind = action == GLFW_PRESS ? WindowEvent::Kind::keyDown : WindowEvent::Kind::keyUp;
  event.key = key;
  of(window).push(event, modifiers);
}

// Of what is typed only '?' is a command: on which key it lies is the keyboard's business.
void Window::onText(GLFWwindow* window, unsigned character) {
  if (character != '?' || ImGui::GetIO().WantCaptureKeyboard) return;
  WindowEvent event;
  event.kind = WindowEvent::Kind::keyDown;
  event.key = '?';
  of(window).push(event, 0);
}

void Window::onButton(GLFWwindow* window, int button, int action, int modifiers) {
  if (button > GLFW_MOUSE_BUTTON_MIDDLE) return;
  if (action == GLFW_PRESS && of(window).isCovered()) return;
  WindowEvent event;
  event.kind = action == GLFW_PRESS ? WindowEvent::Kind::buttonDown : WindowEvent::Kind::buttonUp;
  event.button = button == GLFW_MOUSE_BUTTON_LEFT    ? Button::left
                 : button == GLFW_MOUSE_BUTTON_RIGHT ? Button::right
                                                     : Button::middle;
  of(window).push(event, modifiers);
}

void Window::onMove(GLFWwindow* window, double x, double y) {
  of(window).pointer_ = Vec2(static_cast<float>(x), static_cast<float>(y));
  of(window).push({}, 0);
}

void Window::onScroll(GLFWwindow* window, double, double y) {
  if (of(window).isCovered()) return;
  WindowEvent event;
  event.kind = WindowEvent::Kind::scroll;
  event.notches = static_cast<float>(y);
  const bool control = glfwGetKey(window, GLFW_KEY_LEFT_CONTROL) == GLFW_PRESS ||
                       glfwGetKey(window, GLFW_KEY_RIGHT_CONTROL) == GLFW_PRESS;
  of(window).push(event, control ? GLFW_MOD_CONTROL : 0);
}

void Window::onFocus(GLFWwindow* window, int focused) {
  WindowEvent event;
  event.kind = WindowEvent::Kind::focusLost;
  if (focused == GLFW_FALSE) of(window).push(event, 0);
}

void Window::setPicture(const DisplayImage& picture) {
  glBindTexture(GL_TEXTURE_2D, texture_);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, picture.width, picture.height, 0, GL_RGB,
               GL_UNSIGNED_BYTE, picture.rgb.data());
  width_ = picture.width, height_ = picture.height;
}

WindowArea Window::pictureArea() const {
  int width = 0, height = 0;
  size(width, height);
  return areaOfPicture({width, height}, column_, {width_, height_});
}

void Window::size(int& width, int& height) const { glfwGetWindowSize(window_, &width, &height); }

void Window::beginFrame(float column) {
  column_ = column;
  covered_.clear();
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
  if (width_ == 0) return;
  const WindowArea area = pictureArea();
  const auto texture = (ImTextureID)(intptr_t)texture_;  // a pointer or a number, by release
  ImGui::GetBackgroundDrawList()->AddImage(texture, ImVec2(area.low.x, area.low.y),
                                           ImVec2(area.high.x, area.high.y));
}

void Window::endFrame() {
  popup_ = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup);
  ImGui::Render();
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  glViewport(0, 0, width, height);
  glClearColor(0.05f, 0.05f, 0.05f, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  glfwSwapBuffers(window_);
}

}  // namespace ninefold
