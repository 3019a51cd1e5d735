#include "master/running/headless.h"

#include <unistd.h>

#include "common/base/cpu_time.h"
#include "common/base/log.h"
#include "common/base/process.h"
#include "common/base/standard_streams.h"
#include "common/scene/methods.h"
#include "master/assembly/picture.h"
#include "master/options/stop_rule.h"
#include "master/output/output_files.h"
#include "master/output/progress.h"
#include "master/output/run_record.h"
#include "master/running/cluster_setup.h"
#include "master/running/frame_machine.h"
#include "master/running/frame_plan.h"
#include "master/running/invitation.h"
#include "master/running/job.h"
#include "master/running/state_plan.h"

namespace ninefold {
namespace {

constexpr Duration kLook = milliseconds(50);  // how late a signal or a failure may be noticed

class HeadlessRun {
 public:
  HeadlessRun(const Options& options, const Job& job, const Listener::Keys& keys);

  int run();

 private:
  std::optional<WorkOrder> nextWork();
  void gatherFrames();
  bool isDone();
  void tellProgress();
  ProgressState progressState() const;
  void writePicture() const;
  void writePictureSoFar();
  void writeStatistics() const;
  Duration elapsed() const;
  Cluster& cluster() { return machine_.cluster(); }
  const Cluster& cluster() const { return machine_.cluster(); }

  const Options& options_;
  const Job& job_;
  const StopRule rule_;
  FramePlan plan_;  // the network thread's, as the two below
  StatePlan states_;
  uint32_t next_ = 0;         // number of the next frame or step
  FrameOrder order_;          // of all frames, but for the key
  std::atomic<bool> enough_;  // no more frames are opened
  PictureMaker picture_;
  RunRecord record_;
  Time nextPicture_{};  // not before
  Progress progress_;
  FrameMachine machine_;  // last: its threads end before what they work on
};

// Of all frames, but for key and weight.
FrameOrder orderOf(const Job& job) {
  FrameOrder order;
  order.settings = job.settings;
  order.extraMask = job.shape.extraMask;
  order.delivery = job.delivery;
  return order;
}

PictureMaker::Setup pictureSetup(const Options& options, const Job& job, int workers) {
  PictureMaker::Setup setup;
  setup.shape = job.shape;
  setup.keeps.error = options.aovs || options.view == PictureView::error;
  setup.keeps.twoRadii = options.converging && usesPhotons(job.needs, job.settings);
  if (sharesNeighbours(options, job.settings.method, options.view))
    setup.keeps.pattern = job.settings.interleave;
  setup.aovMask = options.aovs ? job.shape.extraMask : 0;
  setup.view = options.view;
  setup.depthScale = kDepthShownWhite * job.sceneRadius;
  setup.surfaceTest = options.surfaceTest;
  setup.exposure = job.exposure, setup.curve = options.toneCurve;
  setup.workers = workers;
  setup.denoise = denoises(options, job.settings.method);
  return setup;
}

HeadlessRun::HeadlessRun(const Options& options, const Job& job, const Listener::Keys& keys)
    : options_(options),
      job_(job),
      rule_(options.stop),
      plan_(job.firstPhotonRadius, job.settings.interleave.sets(), options.converging),
      states_(job.settings),
      order_(orderOf(job)),
      enough_(false),
      picture_(pictureSetup(options, job, FrameMachine::workers())),
      progress_(::isatty(STDERR_FILENO) == 1, Clock::now()),
      machine_(options, keys, *job.offer,
               {[this] { return nextWork(); },
                [this](int worker, const GatheredFrame& frame, int tile) {
                  picture_.finishTile(worker, frame, tile);
                },
                nullptr, nullptr, [this](const StepKey& step) { states_.done(step); }}) {}

// On the network thread.
std::optional<WorkOrder> HeadlessRun::nextWork() {
  std::optional<int64_t> framesLeft;
  if (rule_.frames) framesLeft = *rule_.frames - plan_.opened();
  if (enough_ || framesLeft == 0) return std::nullopt;
  if (const auto step = states_.nextStep(next_, false, framesLeft)) {
    ++next_;
    return StepOrder{order_, step->key, step->units};
  }
  const std::optional<uint32_t> state = states_.versionOfFrame(false);
  if (!state) return std::nullopt;
  FrameOrder order = order_;
  order.key = plan_.next();
  order.key.frame = next_++, order.key.state = *state;
  if (options_.filterAtClients)
    order.neighbourWeight = plan_.neighbourWeight(order.key.randomization);
  machine_.open(order, job_.shape);
  return order;
}

int HeadlessRun::run() {
  machine_.start();
  gatherFrames();
  cluster().stop("the picture is done");
  if (picture_.frames() > 0) writePicture();
  cluster().join();
  if (picture_.frames() > 0 || cluster().failure()) writeStatistics();
  if (const auto failure = cluster().failure()) fail("{}", *failure);
  if (picture_.frames() == 0) warn("stopped before any frame was complete: nothing is written");
  return cluster().signal() == 0 ? 0 : 128 + cluster().signal();
}

void HeadlessRun::gatherFrames() {
  while (!isDone()) {
    tellProgress();
    if (const auto frame = machine_.next(Clock::now() + kLook)) {
      picture_.frameDone();
      record_.frameDone(*frame, processCpuTime());
      writePictureSoFar();
      machine_.release(*frame);
    }
  }
  enough_ = true;
  const std::string end = progress_.finish(progressState(), Clock::now());
  sayToPeople(end);
}

bool HeadlessRun::isDone() {
  const bool metRule = rule_.isMet(picture_.frames(), elapsed(), picture_.relativeError());
  return metRule || cluster().signal() != 0 || cluster().failure();
}

Duration HeadlessRun::elapsed() const {
  const std::optional<Time> begin = cluster().firstDispatch();
  return begin ? Clock::now() - *begin : Duration{0};
}

void HeadlessRun::tellProgress() {
  if (const auto text = progress_.update(progressState(), Clock::now())) sayToPeople(*text);
}

ProgressState HeadlessRun::progressState() const {
  const double fraction = rule_.fraction(picture_.frames(), elapsed(), picture_.relativeError());
  return {fraction, picture_.frames(), rule_.frames, cluster().summary()};
}

// Between two frames, as a picture must be written. The clients trace on meanwhile.
void HeadlessRun::writePictureSoFar() {
  if (!options_.outputEvery || Clock::now() < nextPicture_ || isDone()) return;
  writePicture();
  nextPicture_ = Clock::now() + fromSeconds(*options_.outputEvery);
}

void HeadlessRun::writePicture() const {
  if (!options_.output) return;
  picture_.write(*options_.output, {{"release", releaseName()},
                                    {"scene", options_.scene},
                                    {"scene_hash", job_.sceneHash},
                                    {"camera", job_.settings.camera.name},
                                    {"preset", nameOf(options_.preset)},
                                    {"denoise", picture_.isDenoised() ? "on" : "off"},
                                    {"seed", fmt::format("{}", job_.settings.seed)},
                                    {"frames", fmt::format("{}", picture_.frames())},
                                    {"image_hash", picture_.imageHash()}});
  log("{} frame(s) in {}", picture_.frames(), *options_.output);
}

void HeadlessRun::writeStatistics() const {
  if (!options_.stats) return;
  RunStats stats = record_.stats(cluster().server(), machine_.busy(), FrameMachine::workers());
  stats.stalls = cluster().stalls();
  stats.frames = picture_.frames();
  stats.relativeError = picture_.relativeError();
  stats.imageHash = picture_.imageHash();
  stats.needs = job_.needs;
  stats.preset = nameOf(options_.preset);
  stats.settings = job_.settings;
  stats.surfaceTest = options_.surfaceTest;
  stats.denoise = options_.output && picture_.isDenoised();
  writeStats(*options_.stats, toJson(stats));
}

}  // namespace

int runHeadless(const Options& options) {
  // What can be told at once comes before a scene is read, which may take long.
  checkGuests(options);
  checkFiles(options);
  const Listener::Keys keys = loadKeys(options);
  const Job job = makeJob(options);
  HeadlessRun run(options, job, keys);
  return run.run();
}

}  // namespace ninefold
