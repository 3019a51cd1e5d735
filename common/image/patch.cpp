#include "common/image/patch.h"

#include <algorithm>
#include <bit>

#include "common/base/error.h"
#include "common/sampling/whole_tile.h"

namespace ninefold {
namespace {

// Calls f(from's plane, to's plane) for every plane of a result that `to` has.
template <typename F>
void forEachPlane(const TileResult& from, TileResult& to, const F& f) {
  const auto rgb = [&f](const RgbPlane& a, RgbPlane& b) { f(a.r, b.r), f(a.g, b.g), f(a.b, b.b); };
  for (size_t layer = 0; layer < kLayers; ++layer) {
    const LayerPlanes& a = from.layers[layer];
    LayerPlanes& b = to.layers[layer];
    if (b.distance.empty()) continue;
    rgb(a.reflectance, b.reflectance);
    rgb(a.irradiance, b.irradiance);
    rgb(a.unfiltered, b.unfiltered);
    f(a.distance, b.distance);
    rgb(a.normal, b.normal);
    f(a.chain, b.chain);
  }
  ExtraPlanes& extras = to.extras;
  if ((to.extraMask & kAlbedoPlane) != 0) rgb(from.extras.albedo, extras.albedo);
  if ((to.extraMask & kNormalPlane) != 0) rgb(from.extras.normal, extras.normal);
  if ((to.extraMask & kCausticPlane) != 0) rgb(from.extras.caustic, extras.caustic);
  if ((to.extraMask & kIrradiancePlane) != 0) rgb(from.extras.irradiance, extras.irradiance);
  if ((to.extraMask & kDepthPlane) != 0) f(from.extras.depth, extras.depth);
  if ((to.extraMask & kObjectPlane) != 0) f(from.extras.object, extras.object);
}

bool isZero(const std::vector<float>& plane) {
  uint32_t bits = 0;
  for (const float value : plane) bits |= std::bit_cast<uint32_t>(value);
  return bits == 0;
}
bool isZero(const RgbPlane& plane) { return isZero(plane.r) && isZero(plane.g) && isZero(plane.b); }

}  // namespace

bool isBlack(const LayerPlanes& layer) {
  return isZero(layer.reflectance) && isZero(layer.irradiance) && isZero(layer.unfiltered);
}

void Patch::reset(const FrameShape& frame, int tile) {
  const TileGrid& grid = frame.grid;
  NINEFOLD_CHECK(tile >= 0);
  NINEFOLD_CHECK(tile < grid.tiles());
  const auto sets = static_cast<size_t>(grid.interleave().sets());
  const bool samePlanes = phases_.size() == sets && frame.layerMask == frame_.layerMask &&
                          frame.extraMask == frame_.extraMask;
  frame_ = frame;
  dark_ = frame.layerMask, glowing_ = 0;
  i0_ = tile % grid.columns() * kTaskSide, j0_ = tile / grid.columns() * kTaskSide;
  x0_ = i0_ * grid.interleave().n, y0_ = j0_ * grid.interleave().m;
  width_ = std::min(grid.width() - x0_, kTaskSide * grid.interleave().n);
  height_ = std::min(grid.height() - y0_, kTaskSide * grid.interleave().m);
  phases_.resize(sets), inner_.resize(sets), reach_.resize(sets);
  for (size_t p = 0; p < sets; ++p) {
    inner_[p] = grid.rect(tile, static_cast<int>(p));
    reach_[p] = rectWithBorder(grid, tile, static_cast<int>(p));
    if (!samePlanes) phases_[p].reset(kSide, kSide, frame.layerMask, frame.extraMask);
    for (LayerPlanes& layer : phases_[p].layers) std::ranges::fill(layer.distance, 0.0f);
  }
}

Patch::Overlap Patch::overlap(int phase, const TaskRect& rect) const {
  const TaskRect& wanted = reach_[static_cast<size_t>(phase)];
  const int i = std::max(rect.i0, wanted.i0), j = std::max(rect.j0, wanted.j0);
  Overlap out;
  out.fromI = i - rect.i0, out.fromJ = j - rect.j0;
  out.to = (j - j0_ + 1) * kSide + (i - i0_ + 1);
  out.width = std::max(0, std::min(rect.i0 + rect.width, wanted.i0 + wanted.width) - i);
  out.height = std::max(0, std::min(rect.j0 + rect.height, wanted.j0 + wanted.height) - j);
  return out;
}

void Patch::place(int phase, const TaskRect& rect, const TileResult& result) {
  if (result.width != rect.width || result.height != rect.height ||
      result.layerMask != layerMask() || result.extraMask != extraMask())
    fail("result of phase {}: {}x{} pixels, layers {}, planes {}; asked for were {}x{}, {}, {}",
         phase, result.width, result.height, result.layerMask, result.extraMask, rect.width,
         rect.height, layerMask(), extraMask());
  const Overlap part = overlap(phase, rect);
  if (part.width == 0) return;
  for (int layer = 0; layer < kLayers; ++layer)
    if (!isBlack(result.layers[static_cast<size_t>(layer)]))
      lighten(static_cast<uint8_t>(1u << layer));
  setGlow(layerMask());
  forEachPlane(result, this->phase(phase), [&](const auto& from, auto& to) {
    for (int j = 0; j < part.height; ++j)
      std::copy_n(from.begin() + (part.fromJ + j) * rect.width + part.fromI, part.width,
                  to.begin() + part.to + j * kSide);
  });
}

}  // namespace ninefold
