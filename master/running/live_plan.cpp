#include "master/running/live_plan.h"

#include <utility>

#include "common/image/layers.h"
#include "common/scene/methods.h"

namespace ninefold {
namespace {

constexpr Duration kAsLongAsItTakes = std::chrono::hours(1);

}  // namespace

LivePlan::LivePlan(const Setup& setup, Time now)
    : setup_(setup),
      state_(setup.state),
      quality_(setup.target),
      atRest_(setup.delivery),
      inMotion_(setup.delivery),
      plan_(planOfRest()),
      states_(setup.state.settings),
      changed_(now),
      firstUnshown_(now) {
  latest_.settings = state_.settings;
  latest_.extraMask = state_.extraMask;
  latest_.scene = scene_ = state_.scene;
  latest_.delivery = setup.delivery;
}

FramePlan LivePlan::planOfRest() const {
  const Settings& s = state_.settings;
  return {s.photonRadius * setup_.sceneRadius, s.interleave.sets(), setup_.converging};
}

void LivePlan::restAnew() {
  plan_ = planOfRest();
  looked_ = 0;
}

std::optional<uint32_t> LivePlan::change(const LiveState& state, Time now) {
  if (!moving_ && setup_.motion && state.hasLightOf(state_)) {
    const bool isSeenAsBefore = state.isSeenAs(state_);
    state_ = state;
    if (isSeenAsBefore) return std::nullopt;
    urgent_ = true;
    const auto firstWanted = supersede();
    looked_ = plan_.opened();
    return firstWanted;
  }
  if (state == state_) return std::nullopt;
  follow(state, now);
  if (!setup_.motion) {
    restAnew();
    states_.restart();
    open_.clear();
    return nextFrame_;
  }
  if (moving_) return std::nullopt;
  moving_ = true;
  quality_.begin();
  lightCameras_.clear();
  return supersede();
}

// The state is another one from now on.
void LivePlan::follow(const LiveState& state, Time now) {
  Settings asSeenFromHere = state.settings;
  asSeenFromHere.camera = state_.settings.camera;
  asSeenFromHere.width = state_.settings.width, asSeenFromHere.height = state_.settings.height;
  if (state.scene != state_.scene || !(asSeenFromHere == state_.settings)) ++world_;
  if (states_.change(state.settings, state.scene != state_.scene)) voidSteps_ = nextFrame_;
  if (!hasStepped_ && states_.remembers()) states_.goAhead();
  state_ = state;
  changed_ = now;
  if (!dirty_) firstUnshown_ = now;
  dirty_ = true;
}

uint32_t LivePlan::openShutter() {
  moments_ = 0;
  restAnew();
  states_.restart();
  open_.clear();
  return nextFrame_;
}

std::optional<int64_t> LivePlan::wantedMoment() const {
  const bool hasRoom = plan_.opened() == moments_ && open_.size() < kInMotion;
  return hasRoom ? moments_ : std::nullopt;
}

void LivePlan::expose(const LiveState& state, Time now) {
  if (!(state == state_)) {
    follow(state, now);
    states_.restart(static_cast<uint32_t>(*moments_));
  }
  ++*moments_;
}

std::optional<int64_t> LivePlan::framesLeft() const {
  if (moments_) return *moments_ - plan_.opened();
  return setup_.frames ? std::optional(looked_ + *setup_.frames - plan_.opened()) : std::nullopt;
}

// The plan goes on with the frames that are given up.
std::optional<uint32_t> LivePlan::supersede() {
  if (open_.empty()) return std::nullopt;
  plan_ = open_.begin()->second.before;
  open_.clear();
  return nextFrame_;
}

uint32_t LivePlan::giveUp() {
  open_.clear();
  dirty_ = moving_;
  restAnew();
  states_.giveUp();
  if (moments_) moments_ = 0;
  return nextFrame_;
}

std::optional<LiveFrame> LivePlan::next(Time now) {
  if (moving_) return nextInMotion(now);
  if (const auto left = framesLeft(); left && *left <= 0) return std::nullopt;
  const std::optional<uint32_t> version = states_.versionOfFrame(false);
  if (!version) return std::nullopt;
  LiveFrame frame = open(now);
  frame.rested = plan_.opened();
  frame.last = setup_.frames && frame.rested + 1 == looked_ + *setup_.frames;
  // Else the last picture of the motion, or of another look, stays for long.
  frame.order.urgent = std::exchange(urgent_, false) || frame.rested == 0;
  const FramePlan before = plan_;
  FrameKey key = plan_.next();
  key.state = *version;
  frame.neighbourWeight = plan_.neighbourWeight(key.randomization);
  hold(frame, key, before);
  return frame;
}

std::optional<StepOrder> LivePlan::nextStep(Time now) {
  const std::optional<int64_t> left = moving_ ? std::nullopt : framesLeft();
  const bool ahead = moving_ && !hasStepped_ && states_.remembers() && !setup_.stepTime;
  const Duration usual = ahead ? kAsLongAsItTakes : quality_.target() / 2;
  const auto step = states_.nextStep(nextFrame_, moving_, left, setup_.stepTime.value_or(usual));
  if (!step) return std::nullopt;
  hasStepped_ = moving_;
  step_ = {*step, moving_, ahead, now, {}};
  ++nextFrame_;
  return StepOrder{open(now).order, *step, ahead};
}

// For the gesture's first step, whatever was changed since.
bool LivePlan::waitsForLight(Time now) {
  if (!step_.ahead || !states_.isStepping()) return false;
  if (now - step_.opened < quality_.target()) return true;
  states_.giveUpStep();
  step_ = {};
  voidSteps_ = nextFrame_;
  return false;
}

std::optional<LiveStep> LivePlan::stepDone(const StepKey& step, Time now) {
  states_.done(step, now - step_.opened);
  if (!(step_.key == step)) return std::nullopt;
  step_.done = stepEnded_ = now;
  return step_;
}

void LivePlan::hold(LiveFrame& frame, const FrameKey& key, const FramePlan& before) {
  frame.order.key = key;
  frame.order.key.frame = nextFrame_++;
  open_.emplace(frame.order.key.frame, Open{frame, before});
}

std::optional<LiveFrame> LivePlan::nextInMotion(Time now) {
  if (!dirty_) {
    const bool isSettled = now - changed_ >= kSettle;
    if (isSettled && open_.empty()) {
      moving_ = false;
      restAnew();
      states_.restart();
      return next(now);
    }
    if (isSettled || !states_.hasNews()) return std::nullopt;
    firstUnshown_ = now;
  }
  if (open_.size() >= kInMotion || waitsForLight(now)) return std::nullopt;
  const std::optional<uint32_t> version = states_.versionOfFrame(true);
  if (!version) return std::nullopt;
  LiveFrame frame = open(now);
  frame.moving = frame.order.urgent = true;
  frame.quality = quality_.current();
  frame.changed = firstUnshown_;
  FrameKey key = planOfRest().next();  // the first frame's random bits
  key.state = *version;
  const Settings& s = frame.order.settings;
  if (factsOf(s.method).lightNeedsView) key.lightCameras = lightCameras_.next(s.camera);
  hold(frame, key, plan_);
  dirty_ = false;
  return frame;
}

// All of a frame but its key. A new job begins whenever anything about it differs from the last.
LiveFrame LivePlan::open(Time now) {
  FrameOrder order = latest_;
  order.settings = settingsAt(moving_ ? quality_.current() : Quality{});
  order.extraMask = planes();
  order.moving = moving_;
  order.delivery = moving_ ? inMotion_ : atRest_;
  if (order.extraMask != 0)
    order.delivery.form = Delivery::Form::layers, order.delivery.exposure = 0;
  if (state_.scene != scene_ || (unsettled_ && !moving_)) {
    scene_ = state_.scene;
    ++order.scene;
    unsettled_ = moving_;
  }
  if (!(order.settings == latest_.settings) || order.scene != latest_.scene ||
      !(order.delivery == latest_.delivery))
    ++order.job;
  latest_ = order;
  LiveFrame frame;
  frame.order = order;
  frame.changed = changed_, frame.opened = now, frame.world = world_;
  return frame;
}

uint8_t LivePlan::planes() const {
  const bool picks = moving_ ? state_.picks : setup_.picks && plan_.opened() == 0;
  return static_cast<uint8_t>(state_.extraMask | (picks ? kPickPlanes : 0));
}

Settings LivePlan::settingsAt(const Quality& quality) const {
  const double size = MotionQuality::kSizes[static_cast<size_t>(quality.size)];
  const double light = MotionQuality::kLights[static_cast<size_t>(quality.light)];
  Settings s = state_.settings;
  s.width = scaled(s.width, size), s.height = scaled(s.height, size);
  const MethodFacts& facts = factsOf(s.method);
  if (facts.has(kDirectVpls)) s.directVpls = scaled(s.directVpls, light);
  if (facts.has(kIndirectVpls)) s.indirectVpls = scaled(s.indirectVpls, light);
  if (facts.has(kCausticPhotons)) s.photons = scaled(s.photons, light);
  if (!moving_) return s;
  // Half of them choose nearly as well, in half the time (docs/performance.md).
  if (facts.has(kReverseVpls)) {
    s.resampling = scaled(s.resampling, 0.5);
    s.cameraPoints = scaled(s.cameraPoints, 0.5);
  }
  // Light from lit surfaces through glass comes back at rest.
  if (s.caustics == Caustics::all) s.caustics = Caustics::direct;
  // One film position a pixel makes no smooth edge anyway. At random in the pixel it makes edges
  // torn, and further from the truth (tests/pipeline/walk_test.cpp).
  s.jitter = false;
  return s;
}

std::optional<LiveFrame> LivePlan::completed(uint32_t frame, Time now) {
  const auto found = open_.find(frame);
  if (found == open_.end()) return std::nullopt;
  const LiveFrame done = found->second.frame;
  open_.erase(found);
  // The time since it was opened, the end of the frame before included. Frames that nobody waits
  // for share the cluster with others: their time tells nothing.
  const Duration waited = std::max(stepEnded_ - done.opened, Duration(0));
  if (done.order.urgent) quality_.took(done.quality, now - done.opened - waited, waited);
  return done;
}

}  // namespace ninefold
