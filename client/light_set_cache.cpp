#include "client/light_set_cache.h"

#include <algorithm>

namespace ninefold {

namespace {

// The light, and the state that it may refer to, for as long as the light is used.
LightSetCache::Shared together(LightSetCache::Shared light, LightSetCache::State state) {
  if (!state) return light;
  using Both = std::pair<LightSetCache::Shared, LightSetCache::State>;
  const auto both = std::make_shared<const Both>(std::move(light), std::move(state));
  return {both, both->first.get()};
}

}  // namespace

LightSetCache::Found LightSetCache::get(const FrameKey& frame, int set, const State& state) {
  std::promise<Shared> promise;
  std::shared_future<Shared> future;
  bool ours = false;
  {
    const std::lock_guard lock(mutex_);
    std::shared_future<Shared>& entry = group(frame, state).sets[set];
    ours = !entry.valid();
    if (ours) entry = promise.get_future().share();
    future = entry;
  }
  if (ours) {
    try {
      promise.set_value(together(make_(frame, set, state.get()), state));
    } catch (...) {
      promise.set_exception(std::current_exception());
    }
  }
  return {future.get(), ours};
}

LightSetCache::Group& LightSetCache::group(const FrameKey& frame, const State& state) {
  const auto same = [&](const Group& g) {
    return g.randomization == frame.randomization && g.photonRadius == frame.photonRadius &&
           g.lightCameras == frame.lightCameras && g.state == state;
  };
  const auto found = std::find_if(groups_.begin(), groups_.end(), same);
  if (found != groups_.end()) {
    groups_.splice(groups_.begin(), groups_, found);
  } else {
    groups_.push_front({frame.randomization, frame.photonRadius, frame.lightCameras, state, {}});
    if (groups_.size() > frames_) groups_.pop_back();
  }
  return groups_.front();
}

}  // namespace ninefold
