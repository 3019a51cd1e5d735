#include "master/running/script_run.h"

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <thread>

#include "common/base/log.h"
#include "master/output/output_files.h"
#include "master/output/stats.h"
#include "master/running/cluster_setup.h"
#include "master/running/invitation.h"
#include "master/running/latency_log.h"
#include "master/running/live_run.h"
#include "master/running/picture_series.h"
#include "master/running/script_player.h"
#include "master/running/shots.h"

namespace ninefold {
namespace {

constexpr Duration kLook = milliseconds(50);  // how late a signal or a failure may be noticed
constexpr Duration kStep = milliseconds(4);   // between two looks at the script or its shutter

// Codes are made as for a window, so that latencies are those that a person at one would feel.
// An exposure that is not known yet is made of radiance.
LiveRun::Pace paceOf(const Options& options, const Job& job, const Script& script) {
  LiveRun::Pace pace{fromSeconds(1e-3 * options.frameTime), !script.rate};
  pace.codesOnly = wantsCodesOnly(options) && job.exposure;
  if (pace.codesOnly) pace.exposure = job.exposure;
  pace.curve = options.toneCurve;
  if (script.rate) pace.frames = script.frames;
  return pace;
}

class ScriptRun {
 public:
  explicit ScriptRun(const Options& options)
      : options_(options),
        job_(makeJob(options)),
        player_(*scriptOf(options, *job_.scene), job_.scene, job_.settings.camera),
        series_(options, job_.exposure, script().rate),
        log_(Clock::now()),
        live_(options, job_, loadKeys(options), paceOf(options, job_, script()),
              [this](const std::shared_ptr<const Shown>& shown) { take(shown); }) {}

  int run() {
    checkScript();
    live_.setView(options_.view);
    moveTo(0);
    live_.start();
    script().rate ? renderPictures() : playInRealTime();
    live_.stop("the script is done");
    series_.finish();
    if (const auto failure = live_.cluster().failure()) fail("{}", *failure);
    return live_.cluster().signal() == 0 ? 0 : 128 + live_.cluster().signal();
  }

 private:
  // On the picture's thread.
  void take(const std::shared_ptr<const Shown>& shown) {
    const std::lock_guard lock(mutex_);
    if (shots_) shots_->take(Clock::now(), latest_);
    if (options_.stats) log_.add(*shown);
    latest_ = shown;
    if (!shown->frame.moving && shown->frames == script().frames) still_ = shown;
    arrived_.notify_all();
  }

  const Script& script() const { return player_.script(); }

  void checkScript() const {
    if ((script().rate || script().shots) && !namesSeries(options_))
      fail("a script with a rate or shots needs --output out.####.png for its pictures");
    const bool needsRate = options_.shutter > 0 || (options_.output && isVideo(*options_.output));
    if (needsRate && !script().rate)
      fail("a film, and --shutter, need a script with a rate: \"rate\": 25, say");
    if (options_.shutter > 0 && script().frames < 2)
      fail(
          "--shutter: blur is the mean of a picture's frames; give the script \"frames\": 16, say");
  }

  bool isOver() const { return live_.cluster().signal() != 0 || live_.cluster().failure(); }

  void moveTo(double time) {
    const ScriptPlayer::Step step = player_.moveTo(time);
    if (step.camera) live_.setCamera(*step.camera);
    if (!step.edit.empty()) live_.edit(step.edit);
  }

  // Waits until `is` holds of a picture, or the run is over. Null if it is over.
  template <typename Condition>
  std::shared_ptr<const Shown> waitFor(const std::shared_ptr<const Shown>& of, Condition is) {
    std::unique_lock lock(mutex_);
    while (!isOver()) {
      if (of != nullptr && is(*of)) return of;
      arrived_.wait_for(lock, kLook);
    }
    return nullptr;
  }

  void renderPictures() {
    for (int i = 0; i < script().pictures() && !isOver(); ++i) {
      const auto shown = options_.shutter > 0 ? blurred(i) : still(i);
      if (shown == nullptr) return;
      const std::string path = series_.write(i, *shown);
      log("picture {} of {} in {}", i + 1, script().pictures(), path);
    }
  }

  std::shared_ptr<const Shown> still(int picture) {
    moveTo(picture / *script().rate);
    const LiveState wanted = live_.state();
    return waitFor(still_, [&](const Shown& s) { return s.state == wanted; });
  }

  // Motion blur: frame k of N shows the moment in the middle of the k-th part of the time for which
  // the shutter is open, from the picture's moment on.
  std::shared_ptr<const Shown> blurred(int picture) {
    {
      const std::lock_guard lock(mutex_);
      still_ = nullptr;
    }
    live_.openShutter();
    while (!isOver()) {
      exposeWanted(picture);
      std::unique_lock lock(mutex_);
      if (still_ != nullptr) return still_;
      arrived_.wait_for(lock, kStep);
    }
    return nullptr;
  }

  void exposeWanted(int picture) {
    const auto k = live_.wantedMoment();
    if (!k || *k >= script().frames) return;
    const double open = (static_cast<double>(*k) + 0.5) / script().frames;
    const auto step = player_.moveTo((picture + options_.shutter * open) / *script().rate);
    live_.expose(step.camera, step.edit);
  }

  void playInRealTime() {
    waitFor(latest_, [](const Shown&) { return true; });  // until clients have the scene
    const Time start = Clock::now();
    {
      const std::lock_guard lock(mutex_);
      log_ = LatencyLog(start);
      if (script().shots && latest_ != nullptr) takeShotsFrom(start);
    }
    for (double now = 0; now <= script().seconds && !isOver();
         now = seconds(Clock::now() - start)) {
      moveTo(now);
      takeShots();
      std::this_thread::sleep_for(kStep);
    }
    takeShots();
    moveTo(script().seconds);
    const LiveState last = live_.state();
    waitFor(latest_, [&](const Shown& s) {
      return s.state == last && !s.frame.moving && s.frames >= script().frames;
    });
    if (shots_) finishShots();
    writeLatest();
  }

  // Needs the lock.
  void takeShotsFrom(Time start) {
    shots_.emplace(start, *script().shots, script().pictures(),
                   [this](int i, const Shown& shown) { series_.write(i, shown); });
  }

  // Needs no new picture: what is there stays on the screen.
  void takeShots() {
    const std::lock_guard lock(mutex_);
    if (shots_) shots_->take(Clock::now(), latest_);
  }

  void finishShots() {
    const std::lock_guard lock(mutex_);
    const std::vector<Shot>& shots = shots_->finish();
    const auto lost = std::ranges::count_if(shots, &Shot::isLost);
    if (lost > 0) warn("{} of {} shots are lost: files took too long", lost, shots.size());
    log_.add(shots);
  }

  // What there is, if the script was ended before its time.
  void writeLatest() {
    const std::lock_guard lock(mutex_);
    if (latest_ == nullptr)
      return warn("stopped before any picture was complete: nothing is written");
    if (options_.output && !script().shots) series_.writeAlone(*latest_);
    if (options_.stats)
      writeStats(*options_.stats, log_.json(options_.scene, live_.cluster().tally()));
  }

  const Options& options_;
  Job job_;
  ScriptPlayer player_;
  PictureSeries series_;
  std::mutex mutex_;
  std::condition_variable arrived_;
  LatencyLog log_;                               // guarded by mutex_
  std::shared_ptr<const Shown> latest_, still_;  // guarded by mutex_
  std::optional<Shots> shots_;                   // guarded by mutex_
  LiveRun live_;
};

}  // namespace

int runScript(const Options& options) {
  checkGuests(options);
  checkFiles(options);
  ScriptRun run(options);
  return run.run();
}

}  // namespace ninefold
