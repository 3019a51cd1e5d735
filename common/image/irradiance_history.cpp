#include "common/image/irradiance_history.h"

#include <algorithm>
#include <cmath>

namespace ninefold {
namespace {

constexpr float kUnitNormal = 127;

}  // namespace

void IrradianceHistory::begin(const Camera& camera, int width, int height) {
  if (isDone_) std::swap(now_, before_);
  if (isForgotten_) before_.width = before_.height = 0;
  isDone_ = isForgotten_ = false;
  isStill_ = before_.camera == camera && before_.width == width && before_.height == height;
  now_.camera = camera, now_.rays = CameraRays(camera, width, height);
  now_.width = width, now_.height = height;
  now_.pixels.resize(now_.at(0, height));
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
    const Pixel& p = before_.pixels[before_.at(i, j)];
    const Vec3 n(p.normal[0], p.normal[1], p.normal[2]);
    const Vec3 y = before_.rays.atDepth(px + 0.5f, py + 0.5f, p.depth);  // from the eye
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

IrradianceHistory::Pixel IrradianceHistory::remembered(int x, int y, Vec3 fresh, Vec3 normal,
                                                       Metres distance, int most) const {
  const float px = static_cast<float>(x) + 0.5f, py = static_cast<float>(y) + 0.5f;
  Pixel pixel;
  pixel.depth = now_.rays.depthOf(px, py, distance);
  Past past;
  if (!isStill_) {
    past = pastOf(now_.camera.eye + now_.rays.atDepth(px, py, pixel.depth), normal, distance);
  } else if (const Pixel& old = before_.pixels[before_.at(x, y)]; old.depth > 0) {
    past = {old.irradiance, static_cast<float>(old.frames)};
  }
  const float n = std::min(past.frames + 1, static_cast<float>(most));
  pixel.irradiance = past.irradiance + (fresh - past.irradiance) / n;
  for (int axis = 0; axis < 3; ++axis)
    pixel.normal[axis] = static_cast<int8_t>(std::rint(kUnitNormal * normal[axis]));
  pixel.frames = static_cast<uint8_t>(n + 0.5f);
  return pixel;
}

void IrradianceHistory::blend(const Patch& patch, const PatchFilter& filter, bool moving,
                              RgbImage& beauty) {
  const bool isDark = patch.isDark(kDiffuse);  // its planes are not to be read
  for (int phase = 0; phase < patch.phases(); ++phase) {
    const LayerPlanes& layer = patch.phase(phase).layers[kDiffuse];
    const RgbPlane& e = filter.irradiance(phase);
    patch.forEachPixel(phase, [&](size_t from, int x, int y) {
      Pixel& pixel = now_.pixels[now_.at(x, y)];
      if (layer.distance[from] == 0 || isDark) {
        pixel = {};
        return;
      }
      const Vec3 fresh(e.r[from], e.g[from], e.b[from]);
      const Vec3 normal(layer.normal.r[from], layer.normal.g[from], layer.normal.b[from]);
      pixel = remembered(x, y, fresh, normal, layer.distance[from], moving ? kMost : kMostKept);
      if (!moving) return;
      const size_t to = beauty.at(x - patch.x0(), y - patch.y0());
      const Vec3 change = pixel.irradiance - fresh;
      beauty.pixels.r[to] += layer.reflectance.r[from] * change.x;
      beauty.pixels.g[to] += layer.reflectance.g[from] * change.y;
      beauty.pixels.b[to] += layer.reflectance.b[from] * change.z;
    });
  }
}

}  // namespace ninefold
