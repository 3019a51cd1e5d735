#include "common/image/frame_filter.h"

#include <algorithm>

#include "common/base/error.h"

namespace ninefold {
namespace {

// Pixel i of the row has index first + step i in the image.
struct Pixels {
  size_t first, step;
};

// beauty = (add ? beauty : 0) + reflectance E' + U for one row of one channel.
void composeRow(const float* reflectance, const float* irradiance, const float* unfiltered,
                int width, bool add, Pixels pixels, float* beauty) {
  for (int i = 0; i < width; ++i) {
    float& to = beauty[pixels.first + pixels.step * static_cast<size_t>(i)];
    const float radiance = reflectance[i] * irradiance[i] + unfiltered[i];
    to = add ? to + radiance : radiance;
  }
}

void composeLayerRow(const LayerPlanes& layer, const RgbPlane& irradiance, size_t row, int width,
                     bool add, Pixels pixels, RgbPlane& beauty) {
  composeRow(layer.reflectance.r.data() + row, irradiance.r.data() + row,
             layer.unfiltered.r.data() + row, width, add, pixels, beauty.r.data());
  composeRow(layer.reflectance.g.data() + row, irradiance.g.data() + row,
             layer.unfiltered.g.data() + row, width, add, pixels, beauty.g.data());
  composeRow(layer.reflectance.b.data() + row, irradiance.b.data() + row,
             layer.unfiltered.b.data() + row, width, add, pixels, beauty.b.data());
}

}  // namespace

void FrameFilter::reset(const TileGrid& grid, uint8_t layerMask, SurfaceTest test) {
  buffer_.reset(grid, test);
  for (int layer = 0; layer < kLayers; ++layer) {
    std::vector<RgbPlane>& phases = filtered_[static_cast<size_t>(layer)];
    phases.resize(hasLayer(layerMask, layer) ? static_cast<size_t>(grid.interleave().sets()) : 0);
    for (size_t p = 0; p < phases.size(); ++p) {
      const int phase = static_cast<int>(p);
      phases[p].resize(pixelCount(grid.subWidth(phase), grid.subHeight(phase)));
    }
  }
}

void FrameFilter::guideRows(const FrameBuffer& frame, const Camera& camera, int phase, int j0,
                            int j1) {
  buffer_.guideRows(frame, camera, phase, j0, j1);
}

void FrameFilter::composeRows(const FrameBuffer& frame, int phase, int j0, int j1,
                              float neighbourWeight, RgbImage& beauty) {
  const TileGrid& grid = frame.grid();
  NINEFOLD_CHECK(beauty.width == grid.width() && beauty.height == grid.height());
  const TileResult& sub = frame.phase(phase);
  bool add = false;
  for (int layer = 0; layer < kLayers; ++layer) {
    if (!hasLayer(frame.layerMask(), layer)) continue;
    std::vector<RgbPlane>& phases = filtered_[static_cast<size_t>(layer)];
    NINEFOLD_CHECK(phases.size() == static_cast<size_t>(grid.interleave().sets()));
    RgbPlane& filtered = phases[static_cast<size_t>(phase)];
    NINEFOLD_CHECK(filtered.r.size() == static_cast<size_t>(sub.count()));
    buffer_.filterRows(frame, layer, phase, j0, j1, neighbourWeight, filtered);
    for (int j = j0; j < j1; ++j) {
      const Pixels pixels{beauty.at(grid.pixelX(phase, 0), grid.pixelY(phase, j)),
                          static_cast<size_t>(grid.interleave().n)};
      composeLayerRow(sub.layers[static_cast<size_t>(layer)], filtered, pixelCount(sub.width, j),
                      sub.width, add, pixels, beauty.pixels);
    }
    add = true;
  }
}

void FrameFilter::compose(const FrameBuffer& frame, const Camera& camera, float neighbourWeight,
                          RgbImage& beauty) {
  const TileGrid& grid = frame.grid();
  beauty.reset(grid.width(), grid.height());
  const int phases = grid.interleave().sets();
  for (int p = 0; p < phases; ++p) guideRows(frame, camera, p, 0, grid.subHeight(p));
  // All phases of a row in turn: they read the same neighbours, which then are still in the cache.
  for (int j = 0; j < grid.subHeight(0); ++j)
    for (int p = 0; p < phases; ++p)
      composeRows(frame, p, j, std::min(j + 1, grid.subHeight(p)), neighbourWeight, beauty);
}

}  // namespace ninefold
