#include "master/running/headless_run.h"

#include <unistd.h>

#include <mutex>
#include <thread>

#include "common/base/cpu_time.h"
#include "common/base/log.h"
#include "common/base/standard_streams.h"
#include "common/scene/methods.h"

namespace ninefold {
namespace {

constexpr Duration kWholeFrame = milliseconds(500);  // that a picture may wait for one
constexpr Duration kLook = milliseconds(50);  // how late a signal or a failure may be noticed

// Of all frames, but for key and weight.
FrameOrder orderOf(const Job& job) {
  FrameOrder order;
  order.settings = job.settings;
  order.layerMask = job.shape.layerMask, order.extraMask = job.shape.extraMask;
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

}  // namespace

HeadlessRun::HeadlessRun(const Options& options, const Job& job, const Listener::Keys& keys)
    : options_(options),
      job_(job),
      rule_(options.stop),
      plan_(firstPlan()),
      states_(job.settings),
      order_(orderOf(job)),
      picture_(pictureSetup(options, job, FrameMachine::workers())),
      keeper_(options, job, picture_),
      progress_(::isatty(STDERR_FILENO) == 1, Clock::now()),
      machine_(options, keys, *job.offer,
               {[this] { return nextWork(); },
                [this](int worker, const GatheredFrame& frame, int tile) {
                  const std::shared_lock adds(filmRests_);
                  picture_.finishTile(worker, frame, tile);
                },
                nullptr, nullptr,
                [this](const StepKey& step, const StatePages& pages) {
                  states_.done(step);
                  keeper_.stepDone(step.to, pages);
                },
                [this] { return next_; }, [this] { goesBack_ = true; }}) {
  goOn();
}

FramePlan HeadlessRun::firstPlan() const {
  return {job_.firstPhotonRadius, job_.settings.interleave.sets(), options_.converging};
}

// Behind what a checkpoint has.
void HeadlessRun::goOn() {
  if (const auto begun = keeper_.resume()) {
    framesBefore_ = begun->frames, before_ = fromSeconds(begun->seconds);
    fractionBefore_ = rule_.fraction(framesBefore_, before_, picture_.relativeError());
    plan_.skip(begun->frames);
    states_.resume(static_cast<uint32_t>(begun->frames), begun->run.state);
    cluster().resume(begun->run);
    if (rule_.frames && begun->frames > *rule_.frames)
      warn("{} has {} frames, more than --frames {}: the picture has them all",
           *options_.checkpoint, begun->frames, *rule_.frames);
  }
  keeper_.reserve();
  cluster().keepStates(statesKept());
}

// From which version on: the trusted one may be needed again.
uint32_t HeadlessRun::statesKept() const {
  const bool mayGoBack = options_.verify > 0;
  const bool isNeeded = isNeededAfterwards(factsOf(job_.settings.method).state);
  return mayGoBack && isNeeded ? keeper_.base().state : UINT32_MAX;
}

// On the network thread.
std::optional<WorkOrder> HeadlessRun::nextWork() {
  std::optional<int64_t> framesLeft;  // of a run that goes on perhaps less than none
  if (rule_.frames) framesLeft = *rule_.frames - plan_.opened();
  if (enough_ || goesBack_ || (framesLeft && *framesLeft <= 0)) return std::nullopt;
  if (const auto step = states_.nextStep(next_, false, framesLeft)) {
    ++next_;
    return StepOrder{order_, *step, false};
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
  machine_.finishNoMore();
  std::string failure;
  try {
    keeper_.end(cluster().tally(), isSettled() && !goesBack_);
  } catch (const Error& error) {
    failure = error.what();
  }
  if (picture_.frames() > 0) writeLastPicture();
  cluster().join();
  writeMetrics(cluster().server().tally());
  if (picture_.frames() > 0 || cluster().failure()) writeStatistics();
  if (const std::string doubt = tellVerification(); failure.empty()) failure = doubt;
  if (const auto ended = cluster().failure()) failure = *ended;
  if (!failure.empty()) fail("{}", failure);
  if (picture_.frames() == 0) warn("stopped before any frame was complete: nothing is written");
  return cluster().signal() == 0 ? 0 : 128 + cluster().signal();
}

void HeadlessRun::gatherFrames() {
  if (options_.saveEvery) nextSave_ = Clock::now();  // the first frame shows something
  while (!isDone()) {
    tellProgress();
    if (options_.metrics && Clock::now() >= nextMetrics_) writeMetrics(cluster().tally());
    if (last_)
      std::this_thread::sleep_for(kLook);
    else if (const auto frame = machine_.next(Clock::now() + kLook))
      keep(*frame);
    saveLate();
    if (goesBack_)
      goBack();
    else
      followTrust();
    keeper_.writeIfDue(cluster().tally(), Clock::now());
  }
  enough_ = true;
  const std::string end = progress_.finish(progressState(), Clock::now());
  sayToPeople(end);
}

// A whole frame. Until its release no worker adds to the film.
void HeadlessRun::keep(const Assembly::Complete& frame) {
  picture_.frameDone();
  record_.frameDone(frame, processCpuTime());
  lastNumber_ = frame.key.frame;
  if (keeper_.frameDone(frame.key, seconds(elapsed()))) cluster().mark(frame.key.frame);
  if (saveIsDue()) savePicture(picture_.copy());
  if (isMet())
    last_ = frame;
  else
    machine_.release(frame);
}

// By a signal or by --save-every. A signal hurries the checkpoint, too.
bool HeadlessRun::saveIsDue() {
  const Time now = Clock::now();
  if (cluster().takeSaveRequest()) {
    keeper_.hurry();
    if (!saveAsked_) saveAsked_ = now;
  }
  return options_.output && (saveAsked_ || (nextSave_ && now >= *nextSave_));
}

// Frames may be long in coming, or clients gone: then what is there is saved, with the tiles of a
// frame that has begun.
void HeadlessRun::saveLate() {
  if (!saveIsDue() || picture_.frames() == 0) return;
  if (!saveAsked_ && picture_.frames() == savedFrames_) return;
  const Time due = saveAsked_ ? *saveAsked_ : *nextSave_;
  if (Clock::now() - due < kWholeFrame) return;
  std::unique_lock rests(filmRests_, std::try_to_lock);
  if (!rests) return;
  const PictureMaker::Copy copy = picture_.copy();
  rests.unlock();
  savePicture(copy);
}

void HeadlessRun::followTrust() {
  if (options_.verify == 0) return;
  const auto trusted = cluster().tally().trusted;
  if (trusted && keeper_.trusted(*trusted)) cluster().keepStates(statesKept());
}

// A client was found wrong: no frame is open any more.
void HeadlessRun::goBack() {
  if (last_) machine_.release(*std::exchange(last_, std::nullopt));
  const int64_t had = picture_.frames();
  const Checkpoint& base = keeper_.goBack();
  savedFrames_ = 0;
  plan_ = firstPlan();
  plan_.skip(base.frames);
  states_.resume(static_cast<uint32_t>(base.frames), base.state);
  framesAgain_ += had - base.frames;
  log("goes back to the picture of {} frame(s), which is trusted; {} are done anew", base.frames,
      had - base.frames);
  goesBack_ = false;
  cluster().wake();
}

bool HeadlessRun::isDone() {
  if (cluster().signal() != 0 || cluster().failure()) return true;
  return (last_ || isMet()) && isSettled() && !goesBack_;  // in this order
}

bool HeadlessRun::isMet() const {
  return rule_.isMet(picture_.frames(), elapsed(), picture_.relativeError());
}

// Nothing that is on the film is still to be verified.
bool HeadlessRun::isSettled() const {
  return options_.verify == 0 || !lastNumber_ || *lastNumber_ < cluster().tally().firstUnsettled;
}

Duration HeadlessRun::elapsed() const {
  const std::optional<Time> begin = cluster().firstDispatch();
  return before_ + (begin ? Clock::now() - *begin : Duration{0});
}

}  // namespace ninefold
