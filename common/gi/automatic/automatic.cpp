#include "common/gi/automatic/automatic.h"

#include <algorithm>
#include <cmath>

#include "common/math/vec.h"
#include "common/sampling/interleave.h"

namespace ninefold {
namespace {

// The trial has light sets of its own, far from those of frames.
constexpr uint32_t kFirstRandomization = 1u << 31;

// Which of them made it.
struct ChosenLight final : FrameLight {
  size_t which = 0;
  std::shared_ptr<const FrameLight> light;

  std::string oddValue() const override { return light->oddValue(); }
};

struct Chosen final : MethodState {
  size_t which = 0;
};

struct TriedScratch final : Scratch {
  std::array<std::unique_ptr<Scratch>, kTried.size()> of;
};

// Squares of pixels that both look at: as a packet of rays has them.
constexpr int kSpots = 32, kSpotSide = 4;

// Spot s of the picture, by Roberts' sequence: evenly over it, whatever its size.
Task spotOf(const Transport& t, const View& view, int s) {
  const TileGrid grid(view.width, view.height, t.settings.interleave);
  const auto place = [&](double step, int sub) {
    const double at = 0.5 + step * s,
                 from = (at - std::floor(at)) * std::max(sub - kSpotSide + 1, 1);
    return std::min(static_cast<int>(from), std::max(sub - kSpotSide, 0));
  };
  Task task;
  task.phase = s % t.settings.interleave.sets();
  const int width = grid.subWidth(task.phase), height = grid.subHeight(task.phase);
  task.rect = TaskRect{place(0.7548776662466927, width), place(0.5698402909980532, height),
                       std::min(kSpotSide, width), std::min(kSpotSide, height)};
  return task;
}

void addLuminance(const TileResult& tile, std::vector<float>& out) {
  const size_t first = out.size(), n = static_cast<size_t>(tile.count());
  out.resize(first + n, 0);
  for (int layer = 0; layer < kLayers; ++layer) {
    if (!hasLayer(tile.layerMask, layer)) continue;
    const LayerPlanes& l = tile.layers[static_cast<size_t>(layer)];
    for (size_t i = 0; i < n; ++i)
      out[first + i] += luminance(Vec3(l.reflectance.r[i] * l.irradiance.r[i] + l.unfiltered.r[i],
                                       l.reflectance.g[i] * l.irradiance.g[i] + l.unfiltered.g[i],
                                       l.reflectance.b[i] * l.irradiance.b[i] + l.unfiltered.b[i]));
  }
}

}  // namespace

std::shared_ptr<const FrameLight> Automatic::light(const FrameKey& frame, int set,
                                                   std::span<const View> views,
                                                   const MethodState* state) const {
  auto chosen = std::make_shared<ChosenLight>();
  if (state != nullptr) chosen->which = static_cast<const Chosen*>(state)->which;
  chosen->light = tried_[chosen->which]->light(frame, set, views, nullptr);
  chosen->rays = chosen->light->rays;
  return chosen;
}

void Automatic::render(const View& view, const Task& task, const FrameLight& light,
                       Scratch& scratch, TileResult& out) const {
  const auto& chosen = static_cast<const ChosenLight&>(light);
  tried_[chosen.which]->render(view, task, *chosen.light,
                               *static_cast<TriedScratch&>(scratch).of[chosen.which], out);
}

std::unique_ptr<Scratch> Automatic::makeScratch() const {
  auto scratch = std::make_unique<TriedScratch>();
  for (size_t i = 0; i < tried_.size(); ++i) scratch->of[i] = tried_[i]->makeScratch();
  return scratch;
}

TrialUnit::Side Automatic::trySide(size_t which, uint32_t unit, const View& view) const {
  const Settings& s = t_.settings;
  FrameKey key;
  key.photonRadius = s.photonRadius * t_.radius;
  key.randomization = kFirstRandomization + unit;
  const int set = static_cast<int>(unit) % s.interleave.sets();
  const auto light = tried_[which]->light(key, set, {&view, 1}, nullptr);
  const auto scratch = tried_[which]->makeScratch();
  TrialUnit::Side side;
  TileResult tile;
  uint64_t rays = 0;
  for (int i = 0; i < kSpots; ++i) {
    Task task = spotOf(t_, view, i);
    if (task.rect->count() == 0) continue;  // a picture smaller than the pattern
    task.frame = key, task.frame.randomization = kFirstRandomization;  // the same for all units
    tried_[which]->render(view, task, *light, *scratch, tile);
    addLuminance(tile, side.radiance);
    rays += tile.rays.total();
  }
  side.setRays = static_cast<float>(light->rays.total());
  side.pixelRays =
      static_cast<float>(rays) / static_cast<float>(std::max<size_t>(side.radiance.size(), 1));
  return side;
}

StepResult Automatic::step(const StatePages&, const StepKey& step, uint32_t unit,
                           const View& view) const {
  unit -= step.firstUnit;
  TrialUnit seen;
  seen.sets = static_cast<float>(t_.settings.interleave.sets());
  seen.pixels = static_cast<float>(view.width) * static_cast<float>(view.height);
  for (size_t i = 0; i < tried_.size(); ++i) seen.sides[i] = trySide(i, unit, view);
  StepResult result;
  result.deltas.push_back(toRecord(unit, seen));
  return result;
}

std::shared_ptr<const MethodState> Automatic::digest(const StatePages& pages,
                                                     const MethodState*) const {
  auto chosen = std::make_shared<Chosen>();
  chosen->which = verdictOf(pages).chosen;
  return chosen;
}

}  // namespace ninefold
