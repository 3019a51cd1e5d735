#include "client/render_job.h"

#include "common/base/log.h"
#include "common/gi/method/too_large.h"
#include "common/gi/whole_state.h"
#include "common/sampling/whole_tile.h"
#include "common/scene/methods.h"
#include "common/scene/replay_line.h"
#include "proto/state_wire.h"
#include "proto/tile_names.h"

namespace ninefold {
namespace {

// Frames whose light sets are kept. At rest a client goes from frame to frame; its threads may
// still be at tasks of an earlier one, and stragglers may be of yet another.
constexpr size_t kFramesKept = 4;

}  // namespace

RenderJob::RenderJob(std::shared_ptr<const TracedScene> scene, uint32_t jobVersion,
                     const Settings& settings, const Delivery& delivery, int threads,
                     const RenderJob* before)
    : light_(lightOf(scene, settings, delivery, threads,
                     before != nullptr ? before->light_.get() : nullptr)),
      jobVersion_(jobVersion),
      settings_(settings),
      delivery_(delivery),
      grid_(settings.width, settings.height, settings.interleave),
      layerMask_(light_->layerMask),
      renderer_(light_->renderer, settings),
      toneMap_(Tone{delivery.exposure, delivery.curve}) {}

RenderJob::RenderJob(const RenderJob& lit, uint32_t jobVersion, const Settings& settings,
                     const Delivery& delivery)
    : light_(lit.light_),
      jobVersion_(jobVersion),
      settings_(settings),
      delivery_(delivery),
      grid_(settings.width, settings.height, settings.interleave),
      layerMask_(lit.layerMask_),
      renderer_(light_->renderer, settings),
      toneMap_(Tone{delivery.exposure, delivery.curve}) {}

// A pure function of the scene, its gesture's beginning and the settings, but for what `before`
// saves.
std::shared_ptr<RenderJob::Light> RenderJob::lightOf(
    const std::shared_ptr<const TracedScene>& scene, const Settings& wanted,
    const Delivery& delivery, int threads, Light* before) {
  Settings settings = wanted;
  std::string refusal, size;
  for (;;) try {
      auto light = std::make_shared<Light>(scene, settings, delivery, threads, before);
      light->isReduced = !refusal.empty();
      if (light->isReduced && (before == nullptr || !before->isReduced))
        warn("after this edit {}; the picture goes on with {}", refusal, size);
      return light;
    } catch (const TooLarge& refused) {
      if (scene->scene == scene->asFetched || !refused.fitting) throw;
      if (refusal.empty()) refusal = refused.what();
      settings = refused.fitting->settings, size = refused.fitting->size;
    }
}

RenderJob::Light::Light(std::shared_ptr<const TracedScene> s, const Settings& its,
                        const Delivery& delivery, int threads, Light* before)
    : scene(std::move(s)),
      settings(its),
      filter(delivery.filter),
      layerMask(layerMaskOf(needsOf(*scene->scene, settings.environment), settings.method)),
      begun(
          !scene->begun ? nullptr
          : before != nullptr && before->scene->begun == scene->begun &&
                  differInViewAlone(before->settings, settings)
              ? before->begun
              : std::make_shared<const Renderer>(scene->begun->tracer, settings, nullptr,
                                                 before != nullptr ? &before->renderer : nullptr)),
      renderer(before != nullptr && before->scene == scene &&
                       differInViewAlone(before->settings, settings)
                   ? Renderer(before->renderer, settings)
                   : Renderer(scene->tracer, settings, begun.get(),
                              before != nullptr ? &before->renderer : nullptr)),
      latestState(before != nullptr && before->settings.method == settings.method
                      ? before->latestState
                      : std::make_shared<LatestState>()),
      states([this](const StatePages& pages,
                    const MethodState* last) { return renderer.digest(pages, last); },
             latestState),
      sets([this](const FrameKey& frame, int set,
                  const MethodState* state) { return renderer.light(frame, set, state); },
           kFramesKept) {
  for (int i = 0; i < threads; ++i) desks.push_back(std::make_unique<Desk>(renderer, filter));
}

bool RenderJob::hasLightOf(const std::shared_ptr<const TracedScene>& scene,
                           const Settings& settings, const Delivery& delivery) const {
  return scene == light_->scene && delivery.filter == light_->filter &&
         haveSameLight(settings_, settings);
}

RenderJob::Done RenderJob::run(const FrameKey& frame, const msg::TaskItem& item,
                               float neighbourWeight, int level, int thread, Time (*now)(),
                               const StatePages& state) {
  Desk& desk = *light_->desks[static_cast<size_t>(thread)];
  const Task task{
      frame, static_cast<int>(item.tile), static_cast<int>(item.phase), item.extraMask, {}};
  const Time start = now();
  Work work{state};
  if (delivery_.wholeTiles())
    traceAndFilter(task, neighbourWeight, desk, work, now);
  else
    trace(task, desk, work, now);
  const uint64_t dither = ditherKey(settings_.seed, frame, item.tile, item.phase);
  const int used = delivery_.level == Delivery::kAdaptive ? level : delivery_.level;
  TileEncoder::Encoded encoded = delivery_.form == Delivery::Form::layers
                                     ? desk.encoder.encode(desk.tile, dither, used)
                                 : delivery_.form == Delivery::Form::radiance
                                     ? desk.encoder.encode(desk.beauty, dither, used)
                                     : desk.encoder.encode(desk.beauty, toneMap_, used);

  msg::Result result;
  result.jobVersion = jobVersion_;
  result.frame = frame.frame;
  result.tile = item.tile;
  result.phase = item.phase;
  result.setsMade = work.setsMade;
  result.replaced = work.replaced.count + encoded.replaced.count;
  result.replacedIn = work.replaced.fields | encoded.replaced.fields;
  result.rays = work.rays;
  result.encoded = std::move(encoded.bytes);
  const Duration busy = now() - start - work.waited;
  result.busyNs = static_cast<uint64_t>(std::chrono::nanoseconds(busy).count());
  return {std::move(result), encoded.rawBytes};
}

msg::Stepped RenderJob::step(const StepKey& step, uint32_t unit, const StatePages& state,
                             Time (*now)()) const {
  const Time start = now();
  const StepResult made = renderer_.step(state, step, unit);
  msg::Stepped result;
  result.jobVersion = jobVersion_;
  result.number = step.number;
  result.unit = unit;
  result.stateHash = state.hash();
  result.rays = made.rays;
  result.deltas = encodeDeltas(made.deltas);
  result.busyNs = static_cast<uint64_t>(std::chrono::nanoseconds(now() - start).count());
  return result;
}

StatePages RenderJob::stateAtRest(uint32_t randomization) const {
  return ninefold::stateAtRest(light_->renderer, settings_, randomization);
}

std::string RenderJob::describe(const FrameKey& frame, const msg::TaskItem& item) const {
  const int set =
      lightSetOfPhase(static_cast<int>(item.phase), frame.rotation, settings_.interleave.sets());
  const TracedScene& scene = *light_->scene;
  std::string what = scene.scene == scene.asFetched ? "" : ", but for edits of the scene";
  if (frame.state != 0) what += ", with the method's state as at rest";
  return fmt::format("frame {}, tile {}, set {} (again{}: {})", frame.frame, item.tile, set, what,
                     replayLine(*scene.scene, settings_, frame, static_cast<int>(item.tile),
                                static_cast<int>(item.phase)) +
                         (delivery_.wholeTiles() ? " --filter-at clients" : ""));
}

void RenderJob::trace(const Task& task, Desk& desk, Work& work, Time (*now)()) {
  const Time start = now();
  const int set = lightSetOfPhase(task.phase, task.frame.rotation, settings_.interleave.sets());
  const MethodStates::Shared state = light_->states.get(task.frame.state, work.state);
  const LightSetCache::Found lights = light_->sets.get(task.frame, set, state);
  if (lights.madeHere)
    ++work.setsMade, work.rays += lights.set->rays;
  else
    work.waited += now() - start;
  renderer_.render(task, *lights.set, *desk.scratch, desk.tile);
  work.rays += desk.tile.rays;
}

void RenderJob::traceAndFilter(const Task& task, float neighbourWeight, Desk& desk, Work& work,
                               Time (*now)()) {
  desk.patch.reset({grid_, layerMask_, 0}, task.tile);
  Task part = task;
  part.extraMask = 0;
  const auto place = [&](const TaskRect& rect) {
    if (rect.count() == 0) return;
    part.rect = rect;
    trace(part, desk, work, now);
    work.replaced += replaceUnusable(desk.tile);  // a pixel must not spoil its neighbours
    desk.patch.place(part.phase, rect, desk.tile);
  };
  for (part.phase = 0; part.phase < settings_.interleave.sets(); ++part.phase) {
    // The tile's own pixels first, in the packets in which a task of layers has them.
    place(grid_.rect(task.tile, part.phase));
    for (const TaskRect& strip : borderOf(grid_, task.tile, part.phase)) place(strip);
  }
  desk.filter.compose(desk.patch, settings_.camera, neighbourWeight, desk.beauty);
}

}  // namespace ninefold
