// render_job.h: a scene and settings made ready, and a task of it done: from key to encoded tile.
//
// A task is one phase of a tile: it is traced, and its layers are sent. If clients filter
// (Delivery), a task is a whole tile: all its phases are traced, with the pixels around it that the
// filter reaches, then filtered. Sent is the finished radiance, or its codes for a display. Both
// are what the master would have made, but for VPL roulette at the tile's border, where packets are
// other ones.
//
// Jobs that differ only in camera, size and form share their light: what was worked out about the
// lamps, the light sets made so far, and the threads' working memory.
// Where a method makes its light for a view, jobs of other cameras and sizes share what was worked
// out about the lamps, but make their own sets.
//
// An edit that the method has no room for goes on under settings that it has room for, with a
// warning (gi/method/too_large.h).
//
// Threads: run() at once for different `thread`; each has its own working memory, light sets are
// shared through the cache.
// Owner: shared_ptr; tasks in progress keep it alive.
// Errors: the constructor throws Error (settings that the scene cannot serve); run() what the
// renderer does.
#pragma once

#include <memory>
#include <vector>

#include "client/light_set_cache.h"
#include "client/method_states.h"
#include "common/base/clock.h"
#include "common/gi/renderer.h"
#include "common/image/patch_filter.h"
#include "common/scene/edit.h"
#include "proto/messages.h"
#include "proto/tile_codec.h"

namespace ninefold {

// A scene, as fetched or edited, and the hierarchy that traces it; in a gesture also the one that
// it was at the gesture's beginning.
struct TracedScene {
  TracedScene(std::shared_ptr<const Scene> fetched, Isa isa)
      : asFetched(std::move(fetched)), scene(asFetched), tracer(*scene, isa) {}
  // `all`: all edits since the scene was fetched. What these leave alone is shared with `before`.
  TracedScene(const TracedScene& before, const SceneEdit& all,
              std::shared_ptr<const TracedScene> itBegan = nullptr)
      : asFetched(before.asFetched),
        scene(std::make_shared<const Scene>(edited(*asFetched, all, before.scene.get()))),
        tracer(before.tracer, *scene, movedInstances(*asFetched, all)),
        begun(std::move(itBegan)) {}

  // What an edit makes of `before`. `all`: as above, the edit included. `moving`: a gesture goes
  // on.
  static std::shared_ptr<const TracedScene> after(const std::shared_ptr<const TracedScene>& before,
                                                  const SceneEdit& all, bool moving) {
    const auto settled = before->begun ? before->begun : before;
    return std::make_shared<TracedScene>(*before, all, moving ? settled : nullptr);
  }

  const std::shared_ptr<const Scene> asFetched, scene;
  const Tracer tracer;
  const std::shared_ptr<const TracedScene> begun;  // null at rest
};

class RenderJob {
 public:
  // `before`: an earlier job. It lends what was worked out about the same scene under another view
  // and, in the same gesture, with the same light, about the gesture's beginning; also what an edit
  // has left as it was (gi/renderer.h).
  RenderJob(std::shared_ptr<const TracedScene> scene, uint32_t jobVersion, const Settings& settings,
            const Delivery& delivery, int threads, const RenderJob* before = nullptr);
  // Another view of the light of `lit`. Needs lit.hasLightOf(its scene, settings, delivery).
  RenderJob(const RenderJob& lit, uint32_t jobVersion, const Settings& settings,
            const Delivery& delivery);
  bool hasLightOf(const std::shared_ptr<const TracedScene>& scene, const Settings& settings,
                  const Delivery& delivery) const;

  struct Done {
    msg::Result result;
    size_t rawBytes = 0;  // of the result, had it not been compressed
  };
  // `neighbourWeight`: of the filter, in [0, 1]. `level`: of zstd, where the job is adaptive.
  // `thread`: 0..threads-1. `state`: pages of version frame.state.
  Done run(const FrameKey& frame, const msg::TaskItem& item, float neighbourWeight, int level,
           int thread, Time (*now)(), const StatePages& state = {});
  // One unit of a step. `state`: pages of version step.from.
  msg::Stepped step(const StepKey& step, uint32_t unit, const StatePages& state,
                    Time (*now)()) const;
  // The pages that light a frame at rest of this randomization (gi/whole_state.h).
  StatePages stateAtRest(uint32_t randomization) const;
  // Names a task for people, with the command that does it again.
  std::string describe(const FrameKey& frame, const msg::TaskItem& item) const;

 private:
  struct Desk : FilterDesk {  // of one thread
    Desk(const Renderer& renderer, SurfaceTest test)
        : FilterDesk(test), scratch(renderer.makeScratch()) {}
    std::unique_ptr<Scratch> scratch;
    TileResult tile;
    TileEncoder encoder;
  };
  struct Work {  // of one task so far
    const StatePages& state;
    Duration waited{0};  // for light sets that another thread makes
    uint32_t setsMade = 0;
    RayCounts rays = {};
    Replaced replaced = {};  // before the filter
  };
  void trace(const Task& task, Desk& desk, Work& work, Time (*now)());
  void traceAndFilter(const Task& task, float neighbourWeight, Desk& desk, Work& work,
                      Time (*now)());

  // What jobs share.
  struct Light {
    Light(std::shared_ptr<const TracedScene> scene, const Settings& settings,
          const Delivery& delivery, int threads, Light* before);
    const std::shared_ptr<const TracedScene> scene;
    const Settings settings;  // those asked for, or, if these have no room, such as have
    bool isReduced = false;   // they are not those asked for
    const SurfaceTest filter;
    const uint8_t layerMask;
    const std::shared_ptr<const Renderer> begun;  // of scene->begun
    const Renderer renderer;
    const std::shared_ptr<LatestState> latestState;
    MethodStates states;
    LightSetCache sets;
    std::vector<std::unique_ptr<Desk>> desks;
  };

  static std::shared_ptr<Light> lightOf(const std::shared_ptr<const TracedScene>& scene,
                                        const Settings& wanted, const Delivery& delivery,
                                        int threads, Light* before);

  const std::shared_ptr<Light> light_;
  const uint32_t jobVersion_;
  const Settings settings_;
  const Delivery delivery_;
  const TileGrid grid_;
  const uint8_t layerMask_;
  const Renderer renderer_;
  const ToneMap toneMap_;
};

}  // namespace ninefold
