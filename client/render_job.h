// render_job.h: a scene and settings made ready, and one task of it from key to encoded tile.
//
// A task is a phase of a tile, sent as it was traced; or, if the job's tiles are filtered here, a
// whole tile: all its phases are traced, with the pixels around it that the filter reaches, and what
// is sent is the radiance that the master would have made of them; but that VPL roulette chooses
// for other packets of receivers, around the tile.
//
// Threads: run may be called at once for different `thread` numbers, each has its own working
// memory; light sets are shared through the cache. Owner: shared_ptr, tasks in progress keep it
// alive. Errors: the constructor throws Error (settings that the scene cannot serve); run what the
// renderer does.
#pragma once

#include <memory>
#include <vector>

#include "client/light_set_cache.h"
#include "common/base/clock.h"
#include "common/gi/renderer.h"
#include "common/image/patch_filter.h"
#include "proto/messages.h"
#include "proto/tile_codec.h"

namespace ninefold {

// A scene with the hierarchy that refers to it.
struct TracedScene {
  TracedScene(Scene&& s, Isa isa) : scene(std::move(s)), tracer(scene, isa) {}
  const Scene scene;
  const Tracer tracer;
};

class RenderJob {
 public:
  RenderJob(std::shared_ptr<const TracedScene> scene, uint32_t jobVersion, const Settings& settings,
            const Delivery& delivery, int threads);

  struct Done {
    msg::Result result;
    size_t rawBytes = 0;  // of the result, had it not been compressed
  };
  // `level`: of zstd, if the job leaves that to the client.
  Done run(const FrameKey& frame, const msg::TaskItem& item, float neighbourWeight, int level,
           int thread, Time (*now)());

 private:
  struct Desk {  // of one thread
    Desk(const Renderer& renderer, SurfaceTest test)
        : scratch(renderer.makeScratch()), filter(test) {}
    std::unique_ptr<Scratch, void (*)(Scratch*)> scratch;
    TileResult tile;
    Patch patch;
    PatchFilter filter;
    RgbImage beauty;
    TileEncoder encoder;
  };
  struct Work {          // of one task so far
    Duration waited{0};  // for light sets that another thread makes
    uint32_t setsMade = 0;
    RayCounts rays;
  };
  void trace(const Task& task, Desk& desk, Work& work, Time (*now)());
  void traceAndFilter(const Task& task, float neighbourWeight, Desk& desk, Work& work,
                      Time (*now)());

  const std::shared_ptr<const TracedScene> scene_;
  const uint32_t jobVersion_;
  const Settings settings_;
  const Delivery delivery_;
  const TileGrid grid_;
  const uint8_t layerMask_;
  const Renderer renderer_;
  LightSetCache sets_;
  std::vector<std::unique_ptr<Desk>> desks_;
};

}  // namespace ninefold
