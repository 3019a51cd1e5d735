// session.h: what happens at the window: events become commands of the camera, the editor and the
// picture board; a script or an animation plays beside them; pictures come back.
//
// Threads: the main thread; the scene is read and pictures are made beside it.
// Errors: throws Error for what the user must know, as runHeadless does.
#pragma once

#include <future>
#include <memory>
#include <mutex>
#include <optional>

#include "master/interaction/window_input.h"
#include "master/running/latency_log.h"
#include "master/running/playback.h"
#include "master/window/editor.h"
#include "master/window/picture_board.h"
#include "master/window/save_dialog.h"

namespace ninefold {

class WindowSession {
 public:
  WindowSession(const Options& options, Window& window, const WindowMemory& memory);
  ~WindowSession();

  // Until the window is closed; the exit status as of runHeadless.
  int run();
  const WindowMemory& memory() const { return memory_; }  // for the next session

 private:
  bool load();  // true once the scene is there
  void start();
  void step();
  void play();
  void takePicture();
  void redraw();
  void writeLast();

  void carryOut(const Command& command);
  void apply(const PanelChanges& changes);
  PanelView panelView() const;
  void show(PictureView view) { live_->setView(view_ = view); }
  void setTone(const Tone& tone);
  void expose(float exposure);
  void exposeByPicture();
  void keepView();
  Scene sceneNow() const;
  void tellTitle();
  void drawPanelAndOverlays();

  const Options& options_;
  Window& window_;
  std::future<Job> loading_;
  WindowInput input_;
  Notice notice_;
  PictureBoard board_;
  SaveDialog saving_;
  std::mutex latencyMutex_;
  LatencyLog latency_;  // of all frames, if somebody wants it; guarded by latencyMutex_

  // Once the scene is there.
  std::optional<Job> job_;
  std::unique_ptr<CameraControl> camera_;
  std::unique_ptr<LiveRun> live_;
  std::unique_ptr<Editor> editor_;
  std::optional<Playback> playback_;
  Time played_{};                // up to now
  std::vector<Camera> cameras_;  // the scene's, and those that were kept
  size_t savedCameras_ = 0;      // of them, in the file

  PictureView view_ = PictureView::beauty;
  float target_ = 100;             // of frames in motion [ms]
  bool autoExposure_ = false;      // by the picture
  bool exposureIsSought_ = false;  // and that has not come yet
  bool panel_ = true, keys_ = false;
  WindowMemory memory_;
  float column_ = 0;  // that the panel takes [screen units]
  std::string title_;
  size_t nextCamera_ = 1;
};

// --window: opens the window, or says why not and runs without one.
int runWindow(const Options& options);

}  // namespace ninefold
