// session.h: what a person does in a live run, whatever shows it: events become commands of the
// camera, the editor and the picture board; a script or an animation plays beside them; pictures
// come back. A window and a browser are its shells: they bring events and show what is drawn.
//
// Threads: the main thread; the scene is read and pictures are made beside it.
// Errors: throws Error for what the user must know, as runHeadless does.
#pragma once

#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <optional>

#include "master/interaction/window_input.h"
#include "master/running/latency_log.h"
#include "master/running/playback.h"
#include "master/session/editor.h"
#include "master/session/picture_board.h"

namespace ninefold {

class Session {
 public:
  static constexpr size_t kMostCameras = 1000;  // the scene's, and those that are kept

  // `wake`: a picture has come; called from another thread.
  Session(const Options& options, Notice& notice, std::function<void()> wake);
  ~Session();

  // True once the scene is there, and the run begun. All that follows needs it.
  bool load();
  bool isLoaded() const { return live_ != nullptr; }
  // Keys are held or a script plays: time alone changes something.
  bool isMoving() const;
  bool isOver() const;  // by a signal or a failure

  // What has happened up to now; `area`: of the picture, in the events' units. The commands that
  // are left to the shell: of saving, of the panel and of closing.
  std::vector<Command> step(const std::vector<WindowEvent>& events, const WindowArea& area);
  // What is to be seen from now on; null if it is what it was.
  const DisplayImage* draw() { return board_.draw(*job_->scene, editor_->selection()); }
  // Whoever held keys and buttons is gone, or another takes over.
  void letGo();

  PanelView panelView() const;
  void apply(const PanelChanges& changes);   // but for saveScene
  std::string progress(double& done) const;  // before there is a picture

  const PictureBoard& board() const { return board_; }
  PictureBoard& board() { return board_; }
  const Cluster& cluster() const { return live_->cluster(); }

  Scene sceneNow() const;
  bool isSaved() const { return editor_->isSaved() && savedCameras_ == cameras_.size(); }
  void setSaved();

  // Ends the run: the last picture and statistics are written. The exit status as of runHeadless.
  int end(const std::string& reason);

 private:
  void start();
  void play();
  void takePicture();
  bool carryOut(const Command& command, const WindowArea& area);  // false: it is the shell's
  void show(PictureView view) { live_->setView(view_ = view); }
  void setTone(const Tone& tone);
  void expose(float exposure);
  void exposeByPicture();
  void keepView();
  void writeLast();

  const Options& options_;
  Notice& notice_;
  const std::function<void()> wake_;
  std::future<Job> loading_;
  WindowInput input_;
  PictureBoard board_;
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
  size_t nextCamera_ = 1;
};

}  // namespace ninefold
