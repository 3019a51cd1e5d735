// live_plan.h: which frames a session wants while its picture changes. Changes and the time go in,
// frames come out. Pure.
//
//   rest     Frames of full quality, one after another, as FramePlan says. The film sums them up,
//            for ever or as many as a still is to have; another look brings as many more. If
//            somebody may click, the first of them carries pick planes, which hold for all.
//   motion   From a change until nothing has changed for kSettle. Each newest state gets one frame,
//            at motion_quality's step, and another one when the method's state has caught up with
//            it by a step; at most kInMotion are open. So that nothing flickers they
//            have the random bits of the first one, look through the middle of each pixel, and take
//            caustics from lights alone. VPLs have half as many candidates. Light that is made for
//            a view is made for the last few (light_cameras.h). An edited scene is announced as
//            moving, and once more when it rests: sample streams are frozen in between
//            (gi/light/transport.h).
//
//            Where clients remember (StateFacts), a gesture's first step makes all units anew. The
//            frame waits for it, for as long as a frame may take. So it has the light of what it
//            shows. A step that takes longer is void. Later steps go beside frames and take half of
//            the time.
//
// The newest state wins. What changed while a frame was rendered is in the next one; changes that
// no frame was opened for are never rendered. A change at rest supersedes the open frames at once.
// In motion the open frame is finished, else a hand that never rests would never see one.
//
//   shutter  Motion blur. Each frame at rest shows a moment of its own, as expose says, and the film
//            sums them up. One is opened for each, at most kInMotion are open.
//
// A change of look alone (LiveState::look, its planes) rests on: open frames are opened anew with
// the new look, and the film keeps all that are complete. Pick planes in motion are no change at
// all.
//
// Threads: plain value, one owner.   Errors: none.   Proved: tests/master/live_plan_test.cpp.
#pragma once

#include <map>
#include <optional>
#include <utility>

#include "master/running/frame_plan.h"
#include "master/running/light_cameras.h"
#include "master/running/motion_quality.h"
#include "master/running/state_plan.h"
#include "master/scheduling/frame_order.h"

namespace ninefold {

// What a session shows: settings (the camera among them) and the planes wanted beside beauty.
struct LiveState {
  Settings settings;
  uint8_t extraMask = 0;
  uint32_t scene = 0;  // edits made so far
  uint32_t look = 0;   // what the picture is made to show of it
  bool picks = false;  // frames in motion carry pick planes
  bool operator==(const LiveState&) const = default;

  // Whether frames of both are estimates of the same light.
  bool hasLightOf(const LiveState& other) const {
    return settings == other.settings && scene == other.scene;
  }
  bool isSeenAs(const LiveState& other) const {
    return hasLightOf(other) && extraMask == other.extraMask && look == other.look;
  }
};

struct LiveFrame {
  FrameOrder order;
  bool moving = false;
  uint32_t world = 0;         // counts changes of anything but the camera and the size
  int64_t rested = 0;         // frames at rest before this one: 0 begins the film anew
  bool last = false;          // of a rest: none follows until something changes
  float neighbourWeight = 1;  // of the filter, in [0, 1]
  Quality quality;
  Time changed{}, opened{};  // changed: when what it shows first for became known
};

// A step of the method's state that is done.
struct LiveStep {
  StepKey key;
  bool moving = false, ahead = false;  // ahead: before the frame that shows what it follows
  Time opened{}, done{};
};

class LivePlan {
 public:
  static constexpr Duration kSettle = milliseconds(250);
  static constexpr size_t kInMotion = 2;

  struct Setup {
    LiveState state;
    Metres sceneRadius = 0;  // frozen: a photon radius must not change while a thing is dragged
    bool converging = true;
    Duration target = milliseconds(100);
    std::optional<Duration> stepTime;  // of a step in motion; nothing: by the target
    bool motion = true;  // false: every state is shown as at rest, however long that takes
    std::optional<int64_t> frames;  // of a state and look at rest; nothing: without end
    Delivery delivery;              // of the first job
    bool picks = false;             // somebody may click
  };
  LivePlan(const Setup& setup, Time now);

  const LiveState& state() const { return state_; }
  // Does nothing if that is shown already. If open frames are not wanted any more, gives the first
  // one that still is.
  std::optional<uint32_t> change(const LiveState& state, Time now);
  // A picture whose shutter is open begins: no frame is opened before expose. Gives the first frame
  // that will be wanted.
  uint32_t openShutter();
  // The number of the moment, from 0, that there is room for; nothing while there is none.
  std::optional<int64_t> wantedMoment() const;
  // One frame more, which shows that.
  void expose(const LiveState& state, Time now);
  // The open frames cannot be rendered any more, and others shall show the same. Gives the first of
  // those. A picture with a shutter begins again.
  uint32_t giveUp();
  void setTarget(Duration target) { quality_.setTarget(target); }
  // Of frames that open from now on. No change of the picture. Frames with planes come as layers.
  void setDelivery(const Delivery& atRest, const Delivery& inMotion) {
    atRest_ = atRest, inMotion_ = inMotion;
  }

  // The next frame to open; nothing while none is wanted, or the state is not there that lights it.
  std::optional<LiveFrame> next(Time now);
  // The next step of the method's state to open: asked before next, and again if that gives none.
  std::optional<StepOrder> nextStep(Time now);
  // Nothing if the step is void.
  std::optional<LiveStep> stepDone(const StepKey& step, Time now);
  // The first step that is wanted, if older ones are void since this was last asked: after change
  // and next.
  std::optional<uint32_t> takeVoidSteps() { return std::exchange(voidSteps_, std::nullopt); }
  // A frame is complete. Nothing if it was superseded.
  std::optional<LiveFrame> completed(uint32_t frame, Time now);

  bool isMoving() const { return moving_; }
  const MotionQuality& quality() const { return quality_; }

 private:
  struct Open {
    LiveFrame frame;
    FramePlan before;  // the plan without it and those after it
  };
  std::optional<uint32_t> supersede();
  void follow(const LiveState& state, Time now);
  std::optional<int64_t> framesLeft() const;
  LiveFrame open(Time now);
  uint8_t planes() const;
  bool waitsForLight(Time now);
  void hold(LiveFrame& frame, const FrameKey& key, const FramePlan& before);
  FramePlan planOfRest() const;
  void restAnew();
  Settings settingsAt(const Quality& quality) const;
  std::optional<LiveFrame> nextInMotion(Time now);

  Setup setup_;
  LiveState state_;
  MotionQuality quality_;
  Delivery atRest_, inMotion_;
  FramePlan plan_;
  StatePlan states_;
  LiveStep step_;  // the latest one that was opened
  Time stepEnded_{};
  std::optional<uint32_t> voidSteps_;
  LightCameras lightCameras_;
  std::optional<int64_t> moments_;  // exposed so far; nothing: there is no shutter
  int64_t looked_ = 0;              // frames of the rest before its latest look
  bool moving_ = false, dirty_ = false;
  bool hasStepped_ = false;  // the latest step was one in motion
  bool urgent_ = false;      // somebody waits for the next frame at rest
  uint32_t world_ = 0;
  uint32_t scene_ = 0;      // LiveState::scene that latest_ shows
  bool unsettled_ = false;  // it was announced as moving
  Time changed_{};          // the latest change
  Time firstUnshown_{};     // the first change that no frame shows yet
  uint32_t nextFrame_ = 0;
  FrameOrder latest_;  // whose job is current
  std::map<uint32_t, Open> open_;
};

}  // namespace ninefold
