#include "master/script_run.h"

#include <condition_variable>
#include <deque>
#include <fstream>
#include <thread>

#include "common/base/log.h"
#include "common/image/image_file.h"
#include "common/image/tone_map.h"
#include "master/cluster_setup.h"
#include "master/latency_log.h"
#include "master/live_run.h"
#include "master/script.h"

namespace ninefold {
namespace {

constexpr Duration kLook = milliseconds(50);  // how late a signal or a failure may be noticed
constexpr Duration kStep = milliseconds(4);   // between two looks at the script

// out.####.png with a number.
std::string numbered(const std::string& pattern, int number) {
  const size_t from = pattern.find('#'), end = pattern.find_first_not_of('#', from);
  const size_t digits = end - from;
  return pattern.substr(0, from) + fmt::format("{:0{}}", number, digits) + pattern.substr(end);
}

class ScriptRun {
 public:
  explicit ScriptRun(const Options& options)
      : options_(options),
        job_(makeJob(options)),
        script_(readScript(*options.script, *job_.scene)),
        log_(Clock::now()),
        live_(options, job_, loadKeys(options),
              {fromSeconds(1e-3 * options.frameTime), !script_.rate},
              [this](const std::shared_ptr<const Shown>& shown) { take(shown); }) {}

  int run() {
    if (script_.rate && (!options_.output || options_.output->find('#') == std::string::npos))
      fail("{} has a rate: give --output out.####.png for its pictures", *options_.script);
    apply(script_.at(0, *job_.scene, job_.settings.camera));
    live_.start();
    script_.rate ? renderPictures() : playInRealTime();
    live_.stop("the script is done");
    if (const auto failure = live_.cluster().failure()) fail("{}", *failure);
    return live_.cluster().signal() == 0 ? 0 : 128 + live_.cluster().signal();
  }

 private:
  // On the picture's thread.
  void take(const std::shared_ptr<const Shown>& shown) {
    const std::lock_guard lock(mutex_);
    log_.add(*shown);
    latest_ = shown;
    if (!shown->frame.moving && shown->frames == script_.frames) still_ = shown;
    arrived_.notify_all();
  }

  bool isOver() const { return live_.cluster().signal() != 0 || live_.cluster().failure(); }

  void apply(const ScriptState& state) {
    live_.setCamera(state.camera);
    if (!(state.edit == applied_)) live_.edit(changesSince(applied_, state.edit));
    applied_ = state.edit;
  }

  // Only what differs travels.
  static SceneEdit changesSince(const SceneEdit& before, const SceneEdit& now) {
    SceneEdit changes;
    const auto keep = [](const auto& then, const auto& all, auto& to) {
      for (const auto& edit : all)
        if (std::ranges::find(then, edit) == then.end()) to.push_back(edit);
    };
    keep(before.objects, now.objects, changes.objects);
    keep(before.lights, now.lights, changes.lights);
    keep(before.materials, now.materials, changes.materials);
    return changes;
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
    for (int i = 0; i < script_.pictures() && !isOver(); ++i) {
      apply(script_.at(i / *script_.rate, *job_.scene, job_.settings.camera));
      const LiveState wanted = live_.state();
      const auto shown = waitFor(still_, [&](const Shown& s) { return s.state == wanted; });
      if (shown == nullptr) return;
      const std::string path = numbered(*options_.output, i);
      writeImage(path, {shown->image, {}, {}}, ToneMap(options_.exposure));
      log("picture {} of {} in {}", i + 1, script_.pictures(), path);
    }
  }

  void playInRealTime() {
    waitFor(latest_, [](const Shown&) { return true; });  // until clients have the scene
    const Time start = Clock::now();
    {
      const std::lock_guard lock(mutex_);
      log_ = LatencyLog(start);
    }
    for (double now = 0; now <= script_.seconds && !isOver(); now = seconds(Clock::now() - start)) {
      apply(script_.at(now, *job_.scene, job_.settings.camera));
      std::this_thread::sleep_for(kStep);
    }
    apply(script_.at(script_.seconds, *job_.scene, job_.settings.camera));
    const LiveState last = live_.state();
    const auto rest = waitFor(latest_, [&](const Shown& s) {
      return s.state == last && !s.frame.moving && s.frames >= script_.frames;
    });
    if (rest == nullptr) return;
    if (options_.output)
      writeImage(*options_.output, {rest->image, {}, {}}, ToneMap(options_.exposure));
    if (options_.stats) writeLatencies();
  }

  void writeLatencies() {
    const std::lock_guard lock(mutex_);
    std::ofstream file(*options_.stats);
    file << log_.json(options_.scene) << "\n";
    if (!file.flush()) fail("cannot write {}", *options_.stats);
  }

  const Options& options_;
  Job job_;
  const Script script_;
  SceneEdit applied_;
  std::mutex mutex_;
  std::condition_variable arrived_;
  LatencyLog log_;                               // guarded by mutex_
  std::shared_ptr<const Shown> latest_, still_;  // guarded by mutex_
  LiveRun live_;
};

}  // namespace

int runScript(const Options& options) {
  if (options.output) checkOutputPath(*options.output);
  ScriptRun run(options);
  return run.run();
}

}  // namespace ninefold
