// render_job.h: a scene and settings made ready, and one task of it from key to encoded tile.
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
            int threads);

  msg::Result run(const FrameKey& frame, const msg::TaskItem& item, int thread, Time (*now)());

 private:
  struct Desk {  // of one thread
    explicit Desk(const Renderer& renderer) : scratch(renderer.makeScratch()) {}
    std::unique_ptr<Scratch, void (*)(Scratch*)> scratch;
    TileResult tile;
    TileEncoder encoder;
  };

  const std::shared_ptr<const TracedScene> scene_;
  const uint32_t jobVersion_;
  const Settings settings_;
  const Renderer renderer_;
  LightSetCache sets_;
  std::vector<std::unique_ptr<Desk>> desks_;
};

}  // namespace ninefold
