// session.h: a session at a window: it brings the events of keys and pointer, and shows the picture
// with the panel beside it.
//
// Threads: the main thread.
// Errors: throws Error for what the user must know, as runHeadless does.
#pragma once

#include "master/session/session.h"
#include "master/window/save_dialog.h"

namespace ninefold {

class WindowSession {
 public:
  WindowSession(const Options& options, Window& window, const WindowMemory& memory);

  // Until the window is closed; the exit status as of runHeadless.
  int run();
  const WindowMemory& memory() const { return memory_; }  // for the next session

 private:
  void step();
  void carryOut(const Command& command);
  void redraw();
  void tellTitle();
  void drawPanelAndOverlays();

  const Options& options_;
  Window& window_;
  Notice notice_;
  Session session_;
  SaveDialog saving_;
  bool panel_ = true, keys_ = false;
  WindowMemory memory_;
  float column_ = 0;  // that the panel takes [screen units]
  std::string title_;
};

// --window: opens the window, or says why not and runs without one.
int runWindow(const Options& options);

}  // namespace ninefold
