#include "client/render_job.h"

#include "common/gi/light_set.h"
#include "common/sampling/interleave.h"

namespace ninefold {
namespace {

// Frames whose light sets are kept: the one that is being finished, the next, and one that
// stragglers may still be of.
constexpr size_t kFramesKept = 3;
constexpr int kZstdLevel = 1;

}  // namespace

RenderJob::RenderJob(std::shared_ptr<const TracedScene> scene, uint32_t jobVersion,
                     const Settings& settings, int threads)
    : scene_(std::move(scene)),
      jobVersion_(jobVersion),
      settings_(settings),
      renderer_(scene_->tracer, settings_),
      sets_([this](const FrameKey& frame, int set) { return renderer_.lightSet(frame, set); },
            kFramesKept) {
  for (int i = 0; i < threads; ++i) desks_.push_back(std::make_unique<Desk>(renderer_));
}

msg::Result RenderJob::run(const FrameKey& frame, const msg::TaskItem& item, int thread,
                           Time (*now)()) {
  Desk& desk = *desks_[static_cast<size_t>(thread)];
  const Task task{frame, static_cast<int>(item.tile), static_cast<int>(item.phase), item.extraMask};
  const int set = lightSetOfPhase(task.phase, frame.rotation, settings_.interleave.sets());

  Time start = now();
  const LightSetCache::Found lights = sets_.get(frame, set);
  if (!lights.madeHere) start = now();  // waiting for another thread's set is not work
  renderer_.render(task, *lights.set, *desk.scratch, desk.tile);
  const uint64_t dither = ditherKey(settings_.seed, frame, item.tile, item.phase);
  TileEncoder::Encoded encoded = desk.encoder.encode(desk.tile, dither, kZstdLevel);

  msg::Result result;
  result.jobVersion = jobVersion_;
  result.frame = frame.frame;
  result.tile = item.tile;
  result.phase = item.phase;
  result.setsMade = lights.madeHere ? 1 : 0;
  result.replaced = encoded.replaced;
  result.rays = desk.tile.rays;
  if (lights.madeHere) result.rays += lights.set->rays;
  result.encoded = std::move(encoded.bytes);
  result.busyNs = static_cast<uint64_t>(std::chrono::nanoseconds(now() - start).count());
  return result;
}

}  // namespace ninefold
