#include "common/image/irradiance_history.h"

#include <algorithm>
#include <cmath>

namespace ninefold {
namespace {

constexpr float kUnitNormal = 127;
constexpr int kMostKept = 255;

}  // namespace

void IrradianceHistory::begin(const Camera& camera, int width, int height) {
  std::swap(now_, before_);
  if (isForgotten_) before_.width = before_.height = 0;
  isForgotten_ = false;
  isStill_ = before_.camera == camera && before_.width == width && before_.height == height;
  now_.camera = camera, now_.width = width, now_.height = height;
  now_.pixels.resize(static_cast<size_t>(width) * static_cast<size_t>(height));
}

IrradianceHistory::Past IrradianceHistory::pastOf(Vec3 x, Vec3 normal, float distance) const {
  Past past;
  if (before_.width == 0) return past;
  const CameraRays rays(before_.camera, before_.width, before_.height);
  const auto film = rays.filmPosition(x - before_.camera.eye);
  if (!film) return past;
  const Vec2 corner = glm::floor(*film - 0.5f), part = *film - 0.5f - corner;
  float weights = 0;
  for (int tap = 0; tap < 4; ++tap) {
    const int i = static_cast<int>(corner.x) + (tap & 1), j = static_cast<int>(corner.y) + tap / 2;
    if (i < 0 || j < 0 || i >= before_.width || j >= before_.height) continue;
    const Pixel& p = before_.pixels[static_cast<size_t>(j) * static_cast<size_t>(before_.width) +
                                    static_cast<size_t>(i)];
    if (p.distance == 0) continue;
    const Vec3 n(p.normal[0], p.normal[1], p.normal[2]);
    if (glm::dot(n, normal) < kSameNormal * kUnitNormal) continue;
    const Vec3 y = before_.camera.eye + p.distance * rays.direction(static_cast<float>(i) + 0.5f,
                                                                    static_cast<float>(j) + 0.5f);
    if (std::abs(glm::dot(normal, y - x)) > kOffPlane * distance) continue;
    const float weight =
        ((tap & 1) != 0 ? part.x : 1 - part.x) * (tap / 2 != 0 ? part.y : 1 - part.y);
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
  const CameraRays rays(now_.camera, now_.width, now_.height);
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
      if (!isStill_) {
        const Vec3 direction =
            rays.direction(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
        past = pastOf(now_.camera.eye + distance * direction, normal, distance);
      } else if (const Pixel& old = before_.pixels[at]; old.distance > 0) {
        past = {old.irradiance, static_cast<float>(old.frames)};
      }
      const float most = moving ? kMost : kMostKept;
      const float n = std::min(past.frames + 1, most);
      pixel.irradiance = past.irradiance + (fresh - past.irradiance) / n;
      pixel.distance = distance;
      for (int axis = 0; axis < 3; ++axis)
        pixel.normal[axis] = static_cast<int8_t>(std::lround(kUnitNormal * normal[axis]));
      pixel.frames = static_cast<uint8_t>(n);
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
