#include "common/image/patch_filter.h"

namespace ninefold {
namespace {

// beauty += reflectance E' + U for one row of one channel, every `step`-th pixel.
void composeRow(const float* reflectance, const float* irradiance, const float* unfiltered,
                int width, int step, float* beauty) {
#pragma GCC ivdep
  for (int i = 0; i < width; ++i)
    beauty[i * step] += reflectance[i] * irradiance[i] + unfiltered[i];
}

}  // namespace

void PatchFilter::compose(const Patch& patch, const Camera& camera, float neighbourWeight,
                          RgbImage& beauty) {
  beauty.reset(patch.width(), patch.height());
  irradiance_.resize(static_cast<size_t>(patch.phases()));
  buffer_.prepare(patch, camera);
  for (int layer = 0; layer < kLayers; ++layer) {
    if (!hasLayer(patch.layerMask(), layer)) continue;
    for (int phase = 0; phase < patch.phases(); ++phase)
      composeLayer(patch, layer, phase, neighbourWeight, beauty);
  }
}

void PatchFilter::paintShares(const Patch& patch, float neighbourWeight, RgbImage& grey) const {
  grey.reset(patch.width(), patch.height());
  if (patch.isDark(kDiffuse)) return;
  std::vector<float> shares;
  for (int phase = 0; phase < patch.phases(); ++phase) {
    buffer_.shares(patch, kDiffuse, phase, neighbourWeight, shares);
    const RgbPlane& reflectance = patch.phase(phase).layers[kDiffuse].reflectance;
    patch.forEachPixel(phase, [&](size_t from, int x, int y) {
      const size_t to = grey.at(x - patch.x0(), y - patch.y0());
      const bool scatters = reflectance.r[from] + reflectance.g[from] + reflectance.b[from] > 0;
      const float share = scatters ? shares[from] : 0;
      grey.pixels.r[to] = grey.pixels.g[to] = grey.pixels.b[to] = share;
    });
  }
}

void PatchFilter::composeLayer(const Patch& patch, int layer, int phase, float neighbourWeight,
                               RgbImage& beauty) {
  RgbPlane& filtered = layer == kDiffuse ? irradiance_[static_cast<size_t>(phase)] : filtered_;
  if (patch.isDark(layer)) {
    filtered.resize(Patch::kPixels);
    return;
  }
  if (filtered.r.empty()) filtered.resize(Patch::kPixels);
  buffer_.filter(patch, layer, phase, neighbourWeight, filtered);
  const LayerPlanes& planes = patch.phase(phase).layers[static_cast<size_t>(layer)];
  const Interleave pattern = patch.grid().interleave();
  const TaskRect& inner = patch.inner(phase);
  if (inner.count() == 0) return;
  for (int j = 0; j < inner.height; ++j) {
    const auto from = static_cast<size_t>((j + 1) * Patch::kSide + 1);
    const size_t to = beauty.at(phase % pattern.n, phase / pattern.n + pattern.m * j);
    const auto row = [&](const std::vector<float>& reflectance, const std::vector<float>& light,
                         const std::vector<float>& unfiltered, std::vector<float>& out) {
      composeRow(&reflectance[from], &light[from], &unfiltered[from], inner.width, pattern.n,
                 &out[to]);
    };
    row(planes.reflectance.r, filtered.r, planes.unfiltered.r, beauty.pixels.r);
    row(planes.reflectance.g, filtered.g, planes.unfiltered.g, beauty.pixels.g);
    row(planes.reflectance.b, filtered.b, planes.unfiltered.b, beauty.pixels.b);
  }
}

}  // namespace ninefold
