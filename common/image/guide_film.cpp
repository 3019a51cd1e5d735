#include "common/image/guide_film.h"

#include <algorithm>
#include <numbers>

namespace ninefold {

void GuideFilm::clear() {
  std::ranges::fill(pixels_, Pixel{});
  frames_ = 0;
}

GuideFilm::Pixel GuideFilm::seen(const Patch& patch, int phase, size_t i) {
  Pixel pixel;
  for (int layer = 0; layer < kLayers; ++layer) {
    if (!hasLayer(patch.layerMask(), layer) || patch.isDark(layer)) continue;
    const LayerPlanes& planes = patch.phase(phase).layers[static_cast<size_t>(layer)];
    const RgbPlane& rho = planes.reflectance;
    pixel.albedo += (rho.r[i] + rho.g[i] + rho.b[i]) * (std::numbers::pi_v<float> / 3);
    if (pixel.nearness > 0 || !(planes.distance[i] > 0)) continue;
    pixel.nearness = 1 / planes.distance[i];
    pixel.normal = Vec3(planes.normal.r[i], planes.normal.g[i], planes.normal.b[i]);
  }
  return pixel;
}

void GuideFilm::addPatch(const Patch& patch) {
  const float share = 1 / static_cast<float>(frames_ + 1);
  for (int phase = 0; phase < patch.phases(); ++phase)
    patch.forEachPixel(phase, [&](size_t from, int x, int y) {
      const Pixel now = seen(patch, phase, from);
      Pixel& mean = pixels_[pixelCount(width_, y) + static_cast<size_t>(x)];
      mean.albedo += (now.albedo - mean.albedo) * share;
      mean.nearness += (now.nearness - mean.nearness) * share;
      mean.normal += (now.normal - mean.normal) * share;
    });
}

DenoiseGuides GuideFilm::guides() const {
  DenoiseGuides out;
  const size_t n = pixels_.size();
  out.albedo.resize(n), out.nearness.resize(n), out.normal.resize(n);
  for (size_t i = 0; i < n; ++i) {
    const Pixel& p = pixels_[i];
    out.albedo[i] = p.albedo, out.nearness[i] = p.nearness;
    out.normal.r[i] = p.normal.x, out.normal.g[i] = p.normal.y, out.normal.b[i] = p.normal.z;
  }
  return out;
}

}  // namespace ninefold
