// session.h: what happens at the window: events move the camera, select and edit; pictures come back.
//
// Threads: the main thread; the scene is read and pictures are made beside it. Errors: throws Error for
// what the user must know, as runHeadless does.
#pragma once

#include <future>
#include <memory>
#include <optional>

#include "common/image/tone_map.h"
#include "master/edit_history.h"
#include "master/live_run.h"
#include "master/window/panel.h"
#include "master/window/window.h"
#include "master/window_input.h"

namespace ninefold {

class WindowSession {
 public:
  WindowSession(const Options& options, Window& window);
  ~WindowSession();

  // Until the window is closed; the exit status as of runHeadless.
  int run();

 private:
  bool load();  // true once the scene is there
  void start();
  void step();
  void carryOut(const Command& command);
  void apply(const PanelChanges& changes);
  void redraw();

  void takePicture();
  void showCodes();
  void savePicture(const std::string& extension);
  void saveScene();
  void saveLast() const;

  void pick(Vec2 pointer);
  void resolvePick();
  void select(uint32_t instance);
  void beginDrag(const Command& command);
  void moveDrag(const Command& command);
  void toggleLamp();
  void edit(const SceneEdit& edit);
  void step(std::optional<SceneEdit> undone);

  PanelView panelView() const;
  Vec2 filmPosition(Vec2 pointer, int width, int height) const;

  const Options& options_;
  Window& window_;
  std::future<Job> loading_;
  std::optional<Job> job_;
  std::unique_ptr<LiveRun> live_;
  std::unique_ptr<CameraControl> camera_;
  std::unique_ptr<EditHistory> history_;
  WindowInput input_;

  std::shared_ptr<const Shown> shown_;
  std::vector<float> frameTimes_;
  Time ratesAt_{};
  uint64_t raysThen_ = 0, tasksThen_ = 0;
  double raysPerSecond_ = 0, tasksPerSecond_ = 0;

  PictureView view_ = PictureView::beauty;
  float exposure_ = 0, target_ = 100;
  std::optional<ToneMap> toneMap_;
  float toneMapFor_ = 0;  // exposure
  bool panel_ = true, dirty_ = true, recording_ = false;
  size_t nextCamera_ = 1;
  int saved_ = 0, recorded_ = 0;
  std::optional<Vec2> pick_;  // film position that waits for a frame with objects
  std::optional<Selection> selection_;
  std::optional<Drag> drag_;
  uint64_t action_ = 1;  // of the edit history
};

// --window: opens the window, or says why not and runs without one.
int runWindow(const Options& options);

}  // namespace ninefold
