#include "master/running/state_plan.h"

#include <algorithm>
#include <utility>

namespace ninefold {

StatePlan::StatePlan(const Settings& settings)
    : facts_(factsOf(settings.method).state), settings_(settings) {}

bool StatePlan::change(const Settings& settings, bool sceneChanged) {
  const Settings before = std::exchange(settings_, settings);
  facts_ = factsOf(settings.method).state;
  const bool isKept =
      before.method == settings.method && (facts_ == nullptr || facts_->isKept(before, settings));
  if (facts_ != nullptr && sceneChanged) stale_ = facts_->unitsOfAll(settings), ++scene_;
  if (isKept) {
    // A step of all that lights frames of the scene before would only keep others waiting.
    const bool isVoid = sceneChanged && open_ && open_->makesAll && latest_ != 0;
    if (isVoid) open_.reset();
    return isVoid;
  }
  latest_ = shown_ = 0, stale_ = 0;
  pace_ = {};
  restart();
  return std::exchange(open_, std::nullopt).has_value();
}

void StatePlan::resume(uint32_t frames, uint32_t version) {
  open_.reset();
  restart();
  index_ = frames;
  latest_ = version, stale_ = 0;
  versions_ = std::max(versions_, version);
  if (facts_ != nullptr && facts_->servesAll() && version != 0) ready_.push_back(version);
}

std::optional<StepKey> StatePlan::nextStep(uint32_t number, bool moving,
                                           std::optional<int64_t> framesLeft, Duration time) {
  if (facts_ == nullptr || open_) return std::nullopt;
  const auto ready = static_cast<int64_t>(ready_.size());
  const bool isWanted = latest_ == 0          ? framesLeft != 0
                        : facts_->servesAll() ? !moving && ready == 0
                        : moving              ? stale_ > 0 && mayStep_
                                 : ready <= 1 && ready < framesLeft.value_or(ready + 1);
  if (!isWanted) return std::nullopt;
  open_ = stepOf(number, moving, time);
  ++versions_;
  mayStep_ = false;
  if (!moving) ++index_;
  nextUnit_ = open_->step.firstUnit + open_->step.units;
  return open_->step;
}

StatePlan::Open StatePlan::stepOf(uint32_t number, bool moving, Duration time) const {
  const bool makesAll = !moving || latest_ == 0;
  const uint32_t all = facts_->unitsOfAll(settings_);
  const uint32_t usual = makesAll ? all : facts_->unitsInMotion(settings_);
  const uint32_t units =
      makesAll || !facts_->isPaced ? usual : pace_.units(usual, std::max(stale_, 1u), time);
  StepKey key;
  key.number = number;
  key.from = makesAll && facts_->beginsAnew ? 0 : latest_, key.to = versions_ + 1;
  key.firstUnit = moving ? nextUnit_ : index_ * units;
  key.randomization = moving ? 0 : index_;
  key.units = units;
  return {key, makesAll, series_, scene_};
}

void StatePlan::done(const StepKey& step, Duration took) {
  if (!open_ || !(open_->step == step)) return;
  const Open done = *std::exchange(open_, std::nullopt);
  latest_ = step.to;
  pace_.took(done.step.units, took);
  if (done.scene == scene_) stale_ -= std::min(stale_, done.step.units);
  if (done.makesAll && done.series == series_ && done.scene == scene_) ready_.push_back(step.to);
}

std::optional<uint32_t> StatePlan::versionOfFrame(bool moving) {
  if (facts_ == nullptr) return 0;
  if (moving) {
    if (latest_ == 0) return std::nullopt;
    mayStep_ = true;
    return shown_ = latest_;
  }
  if (ready_.empty()) return std::nullopt;
  const uint32_t version = ready_.front();
  if (!facts_->servesAll()) ready_.pop_front();
  return version;
}

}  // namespace ninefold
