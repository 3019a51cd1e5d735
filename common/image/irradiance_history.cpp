#include "common/image/irradiance_history.h"

#include <algorithm>
#include <cmath>

namespace ninefold {
namespace {

constexpr float kUnitNormal = 127;
constexpr int kMostKept = 255;

}  // namespace

void IrradianceHistory::begin(const Camera& camera, int width, int height) {
  if (isDone_) std::swap(now_, before_);
  if (isForgotten_) before_.width = before_.height = 0;
  isDone_ = isForgotten_ = false;
  isStill_ = before_.camera == camera && before_.width == width && before_.height == height;
  now_.camera = camera, now_.rays = CameraRays(camera, width, height);
  now_.width = width, now_.height = height;
  now_.pixels.resize(static_cast<size_t>(width) * static_cast<size_t>(height));
}

IrradianceHistory::Past IrradianceHistory::pastOf(Vec3 x, Vec3 normal, Metres distance) const {
  Past past;
  if (before_.width == 0) return past;
  const Vec3 fromEye = x - before_.camera.eye;
  const auto film = before_.rays.filmPosition(fromEye);
  if (!film) return past;
  const float left = std::floor(film->x - 0.5f), top = std::floor(film->y - 0.5f);
  if (!(left >= -1 && top >= -1 && left < static_cast<float>(before_.width) &&
        top < static_cast<float>(before_.height)))
    return past;
  const float shareX = film->x - 0.5f - left, shareY = film->y - 0.5f - top;
  const float planeAt = glm::dot(normal, fromEye), tolerance = kOffPlane * distance;
  float weights = 0;
  for (int tap = 0; tap < 4; ++tap) {
    const float px = left + static_cast<float>(tap & 1), py = top + static_cast<float>(tap >> 1);
    const int i = static_cast<int>(px), j = static_cast<int>(py);
    if (i < 0 || j < 0 || i >= before_.width || j >= before_.height) continue;
    const Pixel& p = before_.pixels[static_cast<size_t>(j) * static_cast<size_t>(before_.width) +
                                    static_cast<size_t>(i)];
    const Vec3 n(p.normal[0], p.normal[1], p.normal[2]);
    const Vec3 y = p.depth * before_.rays.onImagePlane(px + 0.5f, py + 0.5f);  // from the eye
    if (p.depth == 0 || glm::dot(n, normal) < kSameNormal * kUnitNormal ||
        std::abs(glm::dot(normal, y) - planeAt) > tolerance)
      continue;
    const float weight =
        ((tap & 1) != 0 ? shareX : 1 - shareX) * ((tap >> 1) != 0 ? shareY : 1 - shareY);
    past.irradiance += weight * p.irradiance;
    past.frames += weight * static_cast<float>(p.frames);
    weights += weight;
  }
  if (weights < kEnough) return {};
  past.irradiance /= weights, past.frames /= weights;
  return past;
}

void IrradianceHistory::blend(const Patch& patch, const PatchFilter& filter, bool moving,
                              RgbImage& beauty) {
  const bool isDark = patch.isDark(kDiffuse);  // its planes are not to be read
  for (int phase = 0; phase < patch.phases(); ++phase) {
    const LayerPlanes& layer = patch.phase(phase).layers[kDiffuse];
    const RgbPlane& e = filter.irradiance(phase);
    patch.forEachPixel(phase, [&](size_t from, int x, int y) {
      const size_t at =
          static_cast<size_t>(y) * static_cast<size_t>(now_.width) + static_cast<size_t>(x);
      Pixel& pixel = now_.pixels[at];
      pixel = {};
      const float distance = layer.distance[from];
      if (distance == 0 || isDark) return;
      const Vec3 normal(layer.normal.r[from], layer.normal.g[from], layer.normal.b[from]);
      const Vec3 fresh(e.r[from], e.g[from], e.b[from]);
      Past past;
      const Vec3 toFilm =
          now_.rays.onImagePlane(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      pixel.depth = distance / glm::length(toFilm);
      if (!isStill_) {
        past = pastOf(now_.camera.eye + pixel.depth * toFilm, normal, distance);
      } else if (const Pixel& old = before_.pixels[at]; old.depth > 0) {
        past = {old.irradiance, static_cast<float>(old.frames)};
      }
      const float most = moving ? kMost : kMostKept;
      const float n = std::min(past.frames + 1, most);
      pixel.irradiance = past.irradiance + (fresh - past.irradiance) / n;
      for (int axis = 0; axis < 3; ++axis)
        pixel.normal[axis] = static_cast<int8_t>(std::rint(kUnitNormal * normal[axis]));
      pixel.frames = static_cast<uint8_t>(n + 0.5f);
      if (!moving) return;
      const size_t to = beauty.at(x - patch.x0(), y - patch.y0());
      const Vec3 rho(layer.reflectance.r[from], layer.reflectance.g[from],
                     layer.reflectance.b[from]);
      const Vec3 change = rho * (pixel.irradiance - fresh);
      beauty.pixels.r[to] += change.x, beauty.pixels.g[to] += change.y,
          beauty.pixels.b[to] += change.z;
    });
  }
}

}  // namespace ninefold
