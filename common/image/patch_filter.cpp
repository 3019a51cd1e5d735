#include "common/image/patch_filter.h"

#include <tuple>

namespace ninefold {
namespace {

// sum += reflectance E' [+ U] of one channel.
void addLight(const Patch& patch, const std::vector<float>& reflectance,
              const std::vector<float>& irradiance, const std::vector<float>* unfiltered,
              std::vector<float>& sum) {
  constexpr int kFirst = Patch::kSide + 1;
  const float *rho = reflectance.data(), *e = irradiance.data();
  float* out = sum.data();
  const int end = patch.inner(0).height * Patch::kSide + patch.inner(0).width + 1;
  if (unfiltered == nullptr) {
#pragma GCC ivdep
    for (int i = kFirst; i < end; ++i) out[i] += rho[i] * e[i];
    return;
  }
  const float* u = unfiltered->data();
#pragma GCC ivdep
  for (int i = kFirst; i < end; ++i) out[i] += rho[i] * e[i] + u[i];
}

// out[x] = rows[x mod n][x / n]
void interleave(const std::vector<const float*>& rows, int width, float* out) {
  const int n = static_cast<int>(rows.size());
  int x = 0;
  if (n == 3) {  // the usual pattern, in vectors
    const float *a = rows[0], *b = rows[1], *c = rows[2];
#pragma GCC ivdep
    for (int i = 0; i < width / 3; ++i)
      out[3 * i] = a[i], out[3 * i + 1] = b[i], out[3 * i + 2] = c[i];
    x = width / 3 * 3;
  }
  for (; x < width; ++x) out[x] = rows[static_cast<size_t>(x % n)][x / n];
}

// The rows y = py, py + m, ... of the tile, of its phases' planes.
void putRows(const Patch& patch, int py, const std::vector<RgbPlane>& phases, RgbImage& out) {
  const int m = patch.grid().interleave().m;
  std::vector<const float*> rows(phases.size());
  for (int y = py; y < patch.height(); y += m)
    for (const auto plane : {&RgbPlane::r, &RgbPlane::g, &RgbPlane::b}) {
      for (size_t px = 0; px < rows.size(); ++px)
        rows[px] = (phases[px].*plane).data() + (y / m + 1) * Patch::kSide + 1;
      interleave(rows, patch.width(), &(out.pixels.*plane)[out.at(0, y)]);
    }
}

bool isLit(const RgbPlane& light, size_t i) { return light.r[i] + light.g[i] + light.b[i] > 0; }

}  // namespace

void PatchFilter::compose(const Patch& patch, const Camera& camera, float neighbourWeight,
                          RgbImage& beauty, RgbImage* unfiltered) {
  const auto [n, m] = patch.grid().interleave();
  beauty.reshape(patch.width(), patch.height());
  if (unfiltered != nullptr) unfiltered->reshape(patch.width(), patch.height());
  irradiance_.resize(static_cast<size_t>(patch.phases()));
  radiance_.resize(static_cast<size_t>(n)), unfiltered_.resize(static_cast<size_t>(n));
  filtered_.reshape(Patch::kPixels);
  buffer_.prepare(patch, camera);
  for (int py = 0; py < m; ++py) {
    for (int px = 0; px < n; ++px) {
      RgbPlane& sum = radiance_[static_cast<size_t>(px)];
      RgbPlane* raw = unfiltered != nullptr ? &unfiltered_[static_cast<size_t>(px)] : nullptr;
      sum.resize(Patch::kPixels);
      if (raw != nullptr) raw->resize(Patch::kPixels);
      for (int layer = 0; layer < kLayers; ++layer)
        if (hasLayer(patch.layerMask(), layer))
          addLayer(patch, layer, py * n + px, neighbourWeight, sum, raw);
    }
    putRows(patch, py, radiance_, beauty);
    if (unfiltered != nullptr) putRows(patch, py, unfiltered_, *unfiltered);
  }
}

void PatchFilter::addLayer(const Patch& patch, int layer, int phase, float neighbourWeight,
                           RgbPlane& sum, RgbPlane* unfiltered) {
  const bool isKept = layer == kDiffuse && keepsIrradiance_;
  RgbPlane& kept = irradiance_[static_cast<size_t>(phase)];
  if (isKept) kept.resize(Patch::kPixels);
  if (patch.isDark(layer)) return;
  RgbPlane& filtered = isKept ? kept : filtered_;
  buffer_.filter(patch, layer, phase, neighbourWeight, filtered);
  const LayerPlanes& planes = patch.phase(phase).layers[static_cast<size_t>(layer)];
  const auto& [rho, e, u] = std::tie(planes.reflectance, filtered, planes.unfiltered);
  const bool glows = patch.glows(layer);
  for (const auto c : {&RgbPlane::r, &RgbPlane::g, &RgbPlane::b}) {
    addLight(patch, rho.*c, e.*c, glows ? &(u.*c) : nullptr, sum.*c);
    if (unfiltered != nullptr)
      addLight(patch, rho.*c, planes.irradiance.*c, glows ? &(u.*c) : nullptr, unfiltered->*c);
  }
}

void PatchFilter::paintShares(const Patch& patch, float neighbourWeight, RgbImage& grey) const {
  grey.reset(patch.width(), patch.height());
  if (patch.isDark(kDiffuse)) return;
  const float alone = 1.0f / static_cast<float>(patch.phases());
  std::vector<float> shares;
  for (int phase = 0; phase < patch.phases(); ++phase) {
    buffer_.shares(patch, kDiffuse, phase, neighbourWeight, shares);
    const LayerPlanes& planes = patch.phase(phase).layers[kDiffuse];
    patch.forEachPixel(phase, [&](size_t from, int x, int y) {
      const size_t to = grey.at(x - patch.x0(), y - patch.y0());
      const bool glows = patch.glows(kDiffuse) && isLit(planes.unfiltered, from);
      const float share = planes.distance[from] > 0 ? shares[from] : (glows ? alone : 0);
      grey.pixels.r[to] = grey.pixels.g[to] = grey.pixels.b[to] = share;
    });
  }
}

}  // namespace ninefold
