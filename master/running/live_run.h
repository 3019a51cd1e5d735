// live_run.h: a session whose picture changes while it is looked at. Clients, scheduler and
// assembly are those of a headless run; a LivePlan says which frames they make.
//
//   any thread: change, edit, shown      network thread: opens frames      workers: finish tiles
//   picture thread: sums frames up, publishes what is to be seen
//
// If clients filter (--filter-at), they do so for views of light (isLight), in tiles that are not
// too large. Other frames, and those with pick planes, come as layers. A frame that is not summed
// up (in motion, or a still of one frame) comes as codes if nobody wants its radiance. What clients
// have filtered has no E any more, so its light is not used again (irradiance_history.h).
//
// Threads: as said.   Owner: the session; ends all its threads when destroyed.
// Errors: the constructor throws Error (cannot listen, bad key); failure() tells what ends the run
// later.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <vector>

#include "master/running/frame_machine.h"
#include "master/running/job.h"
#include "master/running/live_picture.h"
#include "master/running/live_plan.h"

namespace ninefold {

// What is to be seen after a frame; constant once published.
struct Shown {
  std::shared_ptr<const LiveImage> image;
  LiveFrame frame;
  LiveState state;  // full size and light, whatever the frame had
  PictureView view = PictureView::beauty;
  Time completed{};
  int64_t frames = 0;  // that the image is the mean of
  double relativeError = 0;
  RayCounts rays;               // of the run so far
  std::vector<LiveStep> steps;  // done since the picture before
};

class LiveRun {
 public:
  // `onPicture`: called on the picture's thread after each frame.
  struct Pace {
    Duration target = milliseconds(100);  // of frames in motion
    bool motion = true;                   // false: every state is rendered as if it rested
    std::optional<float> exposure = {};   // [EV]: somebody looks at codes; none: at radiance only
    ToneCurve curve = ToneCurve::srgb;    // of codes
    bool codesOnly = false;               // and at nothing else, unless frames are summed up
    std::optional<int64_t> frames = {};   // of a picture at rest, at most
    bool person = false;                  // somebody may click, and look at its error, at any time
  };
  using OnPicture = std::function<void(const std::shared_ptr<const Shown>&)>;
  LiveRun(const Options& options, Job& job, const Listener::Keys& keys, Pace pace,
          OnPicture onPicture);
  ~LiveRun();

  void start();

  // The newest state wins.
  void setSettings(const Settings& settings);
  void setCamera(const Camera& camera);
  void setView(PictureView view);
  void wantPicks(bool on);          // in motion, too, from now on
  void setTarget(Duration target);  // of frames in motion
  void setTone(const Tone& tone);   // of the codes of frames from now on
  // Needs checkEdit.
  void edit(const SceneEdit& edit);

  // Motion blur, for a picture of Pace::frames frames (live_plan.h): opens the shutter; the moment
  // that the next frame shall show; shows it.
  void openShutter();
  std::optional<int64_t> wantedMoment() const;
  void expose(const std::optional<Camera>& camera, const SceneEdit& edit);

  LiveState state() const;    // the newest
  Settings settings() const;  // as wanted at rest
  Needs needs() const;        // of the scene as it is now
  bool isMoving() const;
  std::shared_ptr<const Shown> shown() const;  // null before the first frame
  const Cluster& cluster() const { return machine_.cluster(); }
  void stop(const std::string& reason);

 private:
  struct Open {
    LiveFrame frame;
    LiveState state;
    LiveLook look;
    std::vector<uint32_t> owners;  // by task
  };
  void end();
  std::optional<WorkOrder> nextWork();
  void noteOwner(const ReceivedTile& tile);
  void stepDone(const StepKey& step);
  uint32_t giveUp();
  void finishTile(int worker, const GatheredFrame& frame, int tile);
  void gatherFrames();
  void change(const std::function<void()>& apply);
  void tellOfShapes(const SceneEdit& edit) const;
  std::function<void()> noted(const SceneEdit& edit);
  LiveState newest() const;
  LiveLook lookAt(const LiveFrame& frame) const;
  Delivery delivery(bool summedUp) const;
  FrameShape shapeOf(const FrameOrder& order) const;
  void setDelivery();
  void publish(const Open& done, Time completed);

  const Options& options_;
  Job& job_;
  const OnPicture onPicture_;
  LivePicture picture_;

  std::mutex editing_;  // edits come one after another
  SceneEdit all_;       // guarded by editing_

  mutable std::mutex mutex_;  // guards all up to shown_; taken after editing_
  LivePlan plan_;
  Settings wanted_;
  Needs needs_;
  SceneEdit unsent_;
  uint32_t edits_ = 0;
  PictureView view_ = PictureView::beauty;
  bool picks_ = false;
  Pace pace_;
  std::map<uint32_t, std::shared_ptr<Open>> open_;
  std::stop_source touching_;    // of the newest complete frame's last touch: a change ends it
  std::vector<LiveStep> steps_;  // done since the newest picture
  std::shared_ptr<const Shown> shown_;

  std::atomic<bool> ending_ = false;
  FrameMachine machine_;  // its threads end before what they work on
  std::thread thread_;
};

}  // namespace ninefold
