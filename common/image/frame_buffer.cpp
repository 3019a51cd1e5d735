#include "common/image/frame_buffer.h"

#include <algorithm>

#include "common/base/error.h"

namespace ninefold {
namespace {

// Calls f(from's plane, to's plane) for every plane of a result, present or empty.
template <typename To, typename F>
void forEachPlane(const TileResult& from, To& to, const F& f) {
  const auto rgb = [&f](const RgbPlane& a, auto& b) { f(a.r, b.r), f(a.g, b.g), f(a.b, b.b); };
  for (size_t layer = 0; layer < kLayers; ++layer) {
    const LayerPlanes& a = from.layers[layer];
    auto& b = to.layers[layer];
    rgb(a.reflectance, b.reflectance);
    rgb(a.irradiance, b.irradiance);
    rgb(a.unfiltered, b.unfiltered);
    f(a.distance, b.distance);
    rgb(a.normal, b.normal);
    f(a.chain, b.chain);
  }
  rgb(from.extras.albedo, to.extras.albedo);
  rgb(from.extras.normal, to.extras.normal);
  rgb(from.extras.caustic, to.extras.caustic);
  f(from.extras.depth, to.extras.depth);
  f(from.extras.object, to.extras.object);
}

// `result` has the rectangle's size and the same planes as the phase that it goes into.
bool fits(const TileResult& result, const TaskRect& rect, const TileResult& phase) {
  bool same = result.width == rect.width && result.height == rect.height &&
              result.layerMask == phase.layerMask && result.extraMask == phase.extraMask;
  const size_t count = static_cast<size_t>(rect.count());
  forEachPlane(result, phase, [&](const auto& from, const auto& to) {
    same = same && from.size() == (to.empty() ? 0 : count);
  });
  return same;
}

}  // namespace

FrameBuffer::FrameBuffer(const TileGrid& grid, uint8_t layerMask, uint8_t extraMask)
    : grid_(grid), layerMask_(layerMask), extraMask_(extraMask) {
  reset(grid, layerMask, extraMask);
}

void FrameBuffer::reset(const TileGrid& grid, uint8_t layerMask, uint8_t extraMask) {
  grid_ = grid, layerMask_ = layerMask, extraMask_ = extraMask;
  phases_.resize(static_cast<size_t>(grid.interleave().sets()));
  for (int p = 0; p < grid.interleave().sets(); ++p)
    phases_[static_cast<size_t>(p)].reset(grid.subWidth(p), grid.subHeight(p), layerMask,
                                          extraMask);
}

void FrameBuffer::place(int tile, int phase, const TileResult& result) {
  NINEFOLD_CHECK(tile >= 0 && tile < grid_.tiles());
  NINEFOLD_CHECK(phase >= 0 && phase < grid_.interleave().sets());
  const TaskRect rect = grid_.rect(tile, phase);
  TileResult& to = phases_[static_cast<size_t>(phase)];
  if (!fits(result, rect, to))
    fail(
        "result of tile {}, phase {}: {}x{} pixels, layers {}, planes {}; asked for were {}x{}, "
        "{}, {}; drop it",
        tile, phase, result.width, result.height, result.layerMask, result.extraMask, rect.width,
        rect.height, layerMask_, extraMask_);
  if (rect.count() == 0) return;
  forEachPlane(result, to, [&](const auto& fromPlane, auto& toPlane) {
    if (toPlane.empty()) return;
    for (int j = 0; j < rect.height; ++j)
      std::copy_n(fromPlane.begin() + j * rect.width, rect.width,
                  toPlane.begin() + (rect.j0 + j) * to.width + rect.i0);
  });
}

}  // namespace ninefold
