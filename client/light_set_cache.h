// light_set_cache.h: light sets that the worker threads of one client share.
//
// The first thread that needs a set makes it; others that need it meanwhile wait. The sets of the
// `frames` frame keys used last are kept, older ones dropped; a task keeps the set that it uses
// alive. A set does not depend on the frame's number or rotation, and on the state of its method,
// not on the number that it has: frames that differ in nothing else of their keys share.
// Threads: get from any thread.
// Errors: what `make` throws reaches everyone who waits for that set.
#pragma once

#include <functional>
#include <future>
#include <list>
#include <map>
#include <memory>
#include <mutex>

#include "common/scene/settings.h"

namespace ninefold {

struct FrameLight;
struct MethodState;

class LightSetCache {
 public:
  using Shared = std::shared_ptr<const FrameLight>;
  using State = std::shared_ptr<const MethodState>;
  using Make = std::function<Shared(const FrameKey&, int set, const MethodState*)>;

  LightSetCache(Make make, size_t frames) : make_(std::move(make)), frames_(frames) {}

  struct Found {
    Shared set;
    bool madeHere = false;  // by this call; else it was there, or another thread made it
  };
  // `state`: of version frame.state; a set keeps the one that it was made of.
  Found get(const FrameKey& frame, int set, const State& state = nullptr);

 private:
  // All sets of one frame key.
  struct Group {
    uint32_t randomization = 0;
    Metres photonRadius = 0;
    std::vector<Camera> lightCameras;
    State state;
    std::map<int, std::shared_future<Shared>> sets;
  };

  Group& group(const FrameKey& frame, const State& state);

  const Make make_;      // constant after construction
  const size_t frames_;  // constant after construction
  std::mutex mutex_;
  std::list<Group> groups_;  // guarded by mutex_; most recently used first
};

}  // namespace ninefold
