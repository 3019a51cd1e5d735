// headless_run.h: a run without a window between its first frame and its files. Internal to
// headless.h.
//
//   headless_run      which frames come, what happens with a whole one, when it is enough
//   headless_result   progress, picture, statistics
//
// Threads: as headless.h says.   Owner: runHeadless.   Errors: run() throws Error.
#pragma once

#include <atomic>
#include <optional>
#include <shared_mutex>
#include <string>

#include "master/assembly/picture.h"
#include "master/options/stop_rule.h"
#include "master/output/progress.h"
#include "master/output/run_record.h"
#include "master/running/film_keeper.h"
#include "master/running/frame_machine.h"
#include "master/running/frame_plan.h"
#include "master/running/job.h"
#include "master/running/state_plan.h"

namespace ninefold {

class HeadlessRun {
 public:
  HeadlessRun(const Options& options, const Job& job, const Listener::Keys& keys);

  int run();

 private:
  std::optional<WorkOrder> nextWork();
  void gatherFrames();
  bool isDone();
  void goOn();
  void goBack();
  bool isMet() const;
  bool isSettled() const;
  void followTrust();
  uint32_t statesKept() const;
  FramePlan firstPlan() const;
  void keep(const Assembly::Complete& frame);
  bool saveIsDue();
  void saveLate();
  void savePicture(const PictureMaker::Copy& copy);
  void tellPicture(const PictureMaker::Copy& copy) const;
  void tellProgress();
  void writeMetrics(const ServerTally& tally);
  ProgressState progressState() const;
  void writePicture(const std::string& path, const PictureMaker::Copy& copy) const;
  void writeLastPicture() const;
  std::string tellVerification() const;
  void writeStatistics() const;
  Duration elapsed() const;  // on all frames, those of a checkpoint included
  Cluster& cluster() { return machine_.cluster(); }
  const Cluster& cluster() const { return machine_.cluster(); }

  const Options& options_;
  const Job& job_;
  const StopRule rule_;
  // The network thread's; the film's while goesBack_ is set.
  FramePlan plan_;
  StatePlan states_;
  uint32_t next_ = 0;  // number of the next frame or step
  FrameOrder order_;   // of all frames, but for the key

  std::atomic<bool> enough_ = false;    // no more frames are opened
  std::atomic<bool> goesBack_ = false;  // none before the trusted picture is there again
  // The film's thread's, from here on.
  std::optional<Assembly::Complete> last_;  // of all frames: not released, so that the film rests
  std::optional<uint32_t> lastNumber_;      // of the latest frame
  int64_t framesAgain_ = 0;
  std::shared_mutex filmRests_;  // shared: a worker adds a tile
  PictureMaker picture_;
  FilmKeeper keeper_;
  int64_t framesBefore_ = 0;  // out of a checkpoint
  Duration before_{0};        // spent on them
  double fractionBefore_ = 0;
  std::optional<Time> nextSave_;   // by --save-every
  std::optional<Time> saveAsked_;  // by a signal
  int64_t savedFrames_ = 0;
  bool saveFails_ = false;  // the last time
  Time nextMetrics_{};
  bool metricsFail_ = false;
  RunRecord record_;
  Progress progress_;
  FrameMachine machine_;  // last: its threads end before what they work on
};

}  // namespace ninefold
