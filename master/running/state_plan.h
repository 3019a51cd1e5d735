// state_plan.h: which steps the state of a method takes, and which version of it lights a frame.
// Pure. Methods without a state have no steps, and version 0 lights their frames.
//
//   rest    Each frame has a state of its own. Step i of a series of frames makes all of it, with
//           randomization i, so that frames are independent. Step i + 1 begins when step i is done:
//           beside the frame that i lights.
//   motion  The latest version lights a frame. After a change of the scene a small step runs beside
//           each frame, until all of the state has been made anew: the picture lags by as many
//           frames. Where the facts say so, the step is as large as there is time for, and goes
//           before the frame if its owner says so.
//
// A state that serves all frames (StateFacts::servesAll) is made once for a series at rest. The
// latest one stays in motion.
//
// The first step, and one after settings under which the state is not right any more, makes all of
// it of nothing.
//
// Proved:  tests/master/state_plan_test.cpp.
// Threads: plain value, one owner.   Errors: none.
#pragma once

#include <deque>
#include <optional>

#include "common/scene/methods.h"
#include "common/scene/settings.h"
#include "master/running/step_pace.h"

namespace ninefold {

// Whether at rest what comes after a frame needs the state that lit it.
inline bool isNeededAfterwards(const StateFacts* facts) {
  return facts != nullptr && (facts->servesAll() || !facts->beginsAnew);
}

class StatePlan {
 public:
  explicit StatePlan(const Settings& settings);

  // Other settings, or another scene. True if the open step is void.
  bool change(const Settings& settings, bool sceneChanged);
  // What was made so far lights none of the frames at rest that follow: those of a series that
  // begins, or goes on with its frame `index` in another state of the scene.
  void restart(uint32_t index = 0) { ready_.clear(), ++series_, index_ = index; }
  // Frames at rest go on behind the first `frames` of a series. `version`: that lit the last of
  // them, if it is needed afterwards, else 0.
  void resume(uint32_t frames, uint32_t version);
  // The open step cannot be done any more, and frames at rest begin anew.
  void giveUp() { open_.reset(), restart(); }
  // Others shall be opened in its place.
  void giveUpStep() { open_.reset(), mayStep_ = true; }

  // The next step to open, as `number`; nothing while none is wanted. `framesLeft`: at rest, that
  // are still to be lit; none: without end.
  // `time`: of a step in motion, for methods whose steps are paced.
  std::optional<StepKey> nextStep(uint32_t number, bool moving, std::optional<int64_t> framesLeft,
                                  Duration time = {});
  // `took`: since it was opened.
  void done(const StepKey& step, Duration took = {});
  // In motion the next step need not wait for a frame.
  void goAhead() { mayStep_ = true; }
  bool remembers() const {
    return facts_ != nullptr && facts_->remembers != nullptr && facts_->remembers(settings_);
  }
  bool isStepping() const { return open_ && !open_->makesAll; }
  // The version that lights the next frame, which is opened now; nothing while it is not there.
  std::optional<uint32_t> versionOfFrame(bool moving);
  // There is a version that no frame in motion has shown.
  bool hasNews() const { return latest_ != 0 && latest_ != shown_; }

 private:
  struct Open {
    StepKey step;
    bool makesAll = false;
    uint32_t series = 0, scene = 0;  // as they were when it opened
  };
  Open stepOf(uint32_t number, bool moving, Duration time) const;

  const StateFacts* facts_;
  Settings settings_;
  std::optional<Open> open_;
  StepPace pace_;
  uint32_t latest_ = 0;    // version; 0: none that is right
  uint32_t shown_ = 0;     // by the last frame in motion
  uint32_t versions_ = 0;  // that steps were opened for
  uint32_t nextUnit_ = 0;
  uint32_t series_ = 0;         // of frames at rest
  uint32_t index_ = 0;          // of the series' next step
  uint32_t scene_ = 0;          // counts changes
  uint32_t stale_ = 0;          // units that show an older scene
  bool mayStep_ = true;         // a frame in motion was opened since the last step
  std::deque<uint32_t> ready_;  // versions for frames at rest
};

}  // namespace ninefold
