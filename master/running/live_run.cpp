#include "master/running/live_run.h"

#include "common/base/log.h"
#include "common/scene/methods.h"

namespace ninefold {
namespace {

constexpr Duration kLook = milliseconds(20);  // how late the end may be noticed

LivePlan::Setup planSetup(const Options& options, const Job& job, LiveRun::Pace pace) {
  LivePlan::Setup setup;
  setup.state.settings = job.settings;
  setup.sceneRadius = job.sceneRadius;
  setup.converging = options.converging;
  setup.target = pace.target;
  if (options.stepTime) setup.stepTime = fromSeconds(1e-3 * *options.stepTime);
  setup.motion = pace.motion;
  setup.frames = pace.frames;
  setup.delivery = job.delivery;
  setup.picks = pace.person;
  return setup;
}

}  // namespace

LiveRun::LiveRun(const Options& options, Job& job, const Listener::Keys& keys, Pace pace,
                 OnPicture onPicture)
    : options_(options),
      job_(job),
      onPicture_(std::move(onPicture)),
      picture_({options.surfaceTest, FrameMachine::workers(), kDepthShownWhite * job.sceneRadius,
                pace.motion}),
      plan_(planSetup(options, job, pace), Clock::now()),
      wanted_(job.settings),
      needs_(job.needs),
      view_(options.view),
      pace_(pace),
      machine_(options, keys, *job.offer,
               {[this] { return nextWork(); },
                [this](int worker, const GatheredFrame& frame, int tile) {
                  finishTile(worker, frame, tile);
                },
                [this](const ReceivedTile& tile) { noteOwner(tile); }, [this] { return giveUp(); },
                [this](const StepKey& step, const StatePages&) { stepDone(step); }}) {
  setDelivery();
}

LiveRun::~LiveRun() {
  end();
  if (thread_.joinable()) thread_.join();
}

void LiveRun::start() {
  machine_.start();
  thread_ = std::thread([this] { gatherFrames(); });
}

// Nobody waits for a touch any more.
void LiveRun::end() {
  const std::lock_guard lock(mutex_);
  ending_ = true;
  touching_.request_stop();
}

void LiveRun::stop(const std::string& reason) {
  end();
  machine_.cluster().stop(reason);
}

void LiveRun::change(const std::function<void()>& apply) {
  std::optional<uint32_t> firstWanted, voidSteps;
  {
    const std::lock_guard lock(mutex_);
    apply();
    setDelivery();
    const LiveState next = newest();
    if (next == plan_.state()) return;
    firstWanted = plan_.change(next, Clock::now());
    voidSteps = plan_.takeVoidSteps();
    if (firstWanted || plan_.isMoving()) touching_.request_stop();
    if (firstWanted) std::erase_if(open_, [&](const auto& f) { return f.first < *firstWanted; });
  }
  if (voidSteps) machine_.cluster().cancelSteps(*voidSteps);
  if (!firstWanted) return machine_.cluster().wake();
  machine_.supersede(*firstWanted);
}

void LiveRun::setSettings(const Settings& settings) {
  change([&] {
    const Camera camera = wanted_.camera;
    wanted_ = settings;
    wanted_.camera = camera;
  });
}

void LiveRun::setCamera(const Camera& camera) {
  change([&] { wanted_.camera = camera; });
}

void LiveRun::setView(PictureView view) {
  change([&] { view_ = view; });
}

void LiveRun::wantPicks(bool on) {
  change([&] { picks_ = on; });
}

void LiveRun::edit(const SceneEdit& edit) {
  const std::lock_guard editing(editing_);
  change(noted(edit));
}

// What is left to do under the lock; needs editing_. An edit of nothing is none.
std::function<void()> LiveRun::noted(const SceneEdit& edit) {
  if (edit.empty()) return [] {};
  tellOfShapes(edit);
  merge(all_, edit);
  std::optional<Needs> needs;  // found before others have to wait
  if (!edit.materials.empty()) needs = needsOf(edited(*job_.scene, all_), settings().environment);
  return [this, edit, needs] {
    merge(unsent_, edit);
    ++edits_;
    if (needs) needs_ = *needs;
  };
}

void LiveRun::openShutter() {
  uint32_t firstWanted = 0;
  {
    const std::lock_guard lock(mutex_);
    firstWanted = plan_.openShutter();
    open_.clear();
  }
  machine_.supersede(firstWanted);
}

std::optional<int64_t> LiveRun::wantedMoment() const {
  const std::lock_guard lock(mutex_);
  return plan_.wantedMoment();
}

void LiveRun::expose(const std::optional<Camera>& camera, const SceneEdit& edit) {
  const std::lock_guard editing(editing_);
  const auto apply = noted(edit);
  std::optional<uint32_t> voidSteps;
  {
    const std::lock_guard lock(mutex_);
    if (camera) wanted_.camera = *camera;
    apply();
    setDelivery();
    plan_.expose(newest(), Clock::now());
    voidSteps = plan_.takeVoidSteps();
  }
  if (voidSteps) machine_.cluster().cancelSteps(*voidSteps);
  machine_.cluster().wake();
}

// Needs editing_. Once for each mesh: an animation changes it with every picture.
void LiveRun::tellOfShapes(const SceneEdit& edit) const {
  for (const ShapeEdit& shape : edit.shapes) {
    const auto isOf = [&](const ShapeEdit& e) { return e.where.mesh == shape.where.mesh; };
    if (shape.where.piece > 0 || std::ranges::any_of(all_.shapes, isOf)) continue;
    const Mesh& mesh = job_.scene->meshes[shape.where.mesh];
    log("the shape of '{}' changes: what clients keep of its {} triangles (ray hierarchy, mesh "
        "elements, lines) is made anew each time",
        mesh.name, mesh.triangles.size());
  }
}

void LiveRun::setTarget(Duration target) {
  const std::lock_guard lock(mutex_);
  plan_.setTarget(target);
}

void LiveRun::setTone(const Tone& tone) {
  const std::lock_guard lock(mutex_);
  pace_.exposure = tone.exposure, pace_.curve = tone.curve;
  setDelivery();
}

LiveState LiveRun::newest() const {
  LiveState state;
  state.settings = settingsFor(view_, wanted_);
  state.extraMask = planesOf(view_);
  state.scene = edits_;
  state.look = static_cast<uint32_t>(view_);
  state.picks = picks_;
  return state;
}

LiveState LiveRun::state() const {
  const std::lock_guard lock(mutex_);
  return plan_.state();
}

Settings LiveRun::settings() const {
  const std::lock_guard lock(mutex_);
  return wanted_;
}

Needs LiveRun::needs() const {
  const std::lock_guard lock(mutex_);
  return needs_;
}

bool LiveRun::isMoving() const {
  const std::lock_guard lock(mutex_);
  return plan_.isMoving();
}

std::shared_ptr<const Shown> LiveRun::shown() const {
  const std::lock_guard lock(mutex_);
  return shown_;
}

LiveLook LiveRun::lookAt(const LiveFrame& frame) const {
  const Settings& settings = frame.order.settings;
  LiveLook look{view_, pace_.exposure, {}};
  look.denoise = denoises(options_, settings.method);
  look.keeps.error = pace_.person || look.denoise || view_ == PictureView::error;
  look.keeps.twoRadii = options_.converging && usesPhotons(needs_, settings);
  if (sharesNeighbours(options_, settings.method, PictureView::beauty))
    look.keeps.pattern = settings.interleave;
  const bool isLightShown = !isFalseColor(view_);
  if (look.exposure && !isLightShown) look.exposure = 0;
  if (isLightShown) look.curve = pace_.curve;
  const bool isSeen = pace_.person || frame.moving || !pace_.frames || frame.last;
  if (!isSeen) look.exposure.reset();
  return look;
}

// Needs the lock. Summed up are frames that there is to be a mean of.
Delivery LiveRun::delivery(bool summedUp) const {
  using Form = Delivery::Form;
  Delivery d = job_.delivery;
  const int pixels = kTaskSide * kTaskSide * wanted_.interleave.sets();
  const bool whole = filtersAtClients(options_, view_) && pixels <= kMaxTilePixels;
  d.form = !whole                                           ? Form::layers
           : !summedUp && pace_.codesOnly && pace_.exposure ? Form::display
                                                            : Form::radiance;
  if (d.form == Form::display) d.exposure = *pace_.exposure, d.curve = pace_.curve;
  return d;
}

// A person may want the radiance of a still of one frame, too.
void LiveRun::setDelivery() {
  plan_.setDelivery(delivery(pace_.person || pace_.frames != 1), delivery(false));
}

FrameShape LiveRun::shapeOf(const FrameOrder& order) const {
  switch (order.delivery.form) {
    case Delivery::Form::radiance:
      return {order.grid(), kRadianceMask, 0};
    case Delivery::Form::display:
      return {order.grid(), kDisplayMask, 0};
    default:
      return {order.grid(), layerMaskOf(needs_, order.settings.method), order.extraMask};
  }
}

// On the network thread.
std::optional<WorkOrder> LiveRun::nextWork() {
  const std::lock_guard lock(mutex_);
  if (ending_) return std::nullopt;
  std::optional<StepOrder> step = plan_.nextStep(Clock::now());
  std::optional<LiveFrame> frame;
  if (!step) frame = plan_.next(Clock::now());
  if (!step && !frame) step = plan_.nextStep(Clock::now());  // it may rest only now
  if (const auto voidSteps = plan_.takeVoidSteps()) machine_.cluster().cancelSteps(*voidSteps);
  if (step) {
    step->edit = std::exchange(unsent_, {});
    return step;
  }
  if (!frame) return std::nullopt;
  FrameOrder& order = frame->order;
  order.edit = std::exchange(unsent_, {});
  if (options_.filterAtClients) order.neighbourWeight = frame->neighbourWeight;
  open_[order.key.frame] = std::make_shared<Open>(
      Open{*frame, plan_.state(), lookAt(*frame),
           std::vector<uint32_t>(static_cast<size_t>(order.grid().tasks()), 0)});
  machine_.open(order, shapeOf(order));
  return order;
}

// On the network thread.
void LiveRun::noteOwner(const ReceivedTile& tile) {
  const std::lock_guard lock(mutex_);
  const auto open = open_.find(tile.result.frame);
  if (open == open_.end()) return;
  const auto sets = static_cast<size_t>(open->second->frame.order.settings.interleave.sets());
  open->second->owners.at(tile.result.tile * sets + tile.result.phase) = tile.client;
}

// On the network thread.
void LiveRun::stepDone(const StepKey& step) {
  const std::lock_guard lock(mutex_);
  if (const auto done = plan_.stepDone(step, Clock::now())) steps_.push_back(*done);
}

// On the network thread.
uint32_t LiveRun::giveUp() {
  const std::lock_guard lock(mutex_);
  open_.clear();
  return plan_.giveUp();
}

// On a worker's thread.
void LiveRun::finishTile(int worker, const GatheredFrame& frame, int tile) {
  std::shared_ptr<Open> open;
  {
    const std::lock_guard lock(mutex_);
    const auto found = open_.find(frame.view.key.frame);
    if (found == open_.end()) return;  // superseded meanwhile
    open = found->second;
  }
  picture_.finishTile(worker, frame, open->frame, open->look, open->owners, tile);
}

void LiveRun::gatherFrames() {
  while (!ending_) {
    const auto frame = machine_.next(Clock::now() + kLook);
    if (!frame) continue;
    std::shared_ptr<const Open> done;
    std::stop_token stop;
    {
      const std::lock_guard lock(mutex_);
      if (plan_.completed(frame->key.frame, frame->finished)) done = open_.at(frame->key.frame);
      if (!ending_) touching_ = {};
      stop = touching_.get_token();
    }
    if (done) {
      picture_.frameDone(stop);
      publish(*done, frame->finished);
    }
    machine_.release(*frame);
    if (done) onPicture_(shown());
  }
}

void LiveRun::publish(const Open& done, Time completed) {
  auto shown = std::make_shared<Shown>();
  shown->image = picture_.image();
  shown->frame = done.frame;
  shown->state = done.state, shown->view = done.look.view;
  shown->completed = completed;
  shown->frames = picture_.frames();
  shown->relativeError = picture_.relativeError();
  shown->rays = machine_.cluster().tally().rays;
  const std::lock_guard lock(mutex_);
  open_.erase(open_.begin(), open_.upper_bound(done.frame.order.key.frame));
  shown->steps = std::exchange(steps_, {});
  shown_ = std::move(shown);
}

}  // namespace ninefold
