#include "common/scene/texture.h"

#include <array>

namespace ninefold {
namespace {

// IEC 61966-2-1, 8-bit code to linear.
std::array<float, 256> makeSrgbTable() {
  std::array<float, 256> table{};
  for (size_t code = 0; code < table.size(); ++code) {
    const double c = static_cast<double>(code) / 255.0;
    table[code] = static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
  }
  return table;
}

const std::array<float, 256> kSrgbToLinear = makeSrgbTable();

float linear(uint8_t code) { return static_cast<float>(code) / 255.0f; }

// Brings u to where `size` texels, or two mirrored copies of them, cover all of it. Far away and
// non-finite coordinates are safe, too, to convert to int afterwards.
float fold(float u, Wrap wrap) {
  if (wrap == Wrap::clamp) return u > 0 ? std::min(u, 1.0f) : 0.0f;
  const float folded = wrap == Wrap::mirror ? u - 2.0f * std::floor(0.5f * u) : u - std::floor(u);
  return folded >= 0 && folded <= 2 ? folded : 0.0f;
}

inline Vec4 texel(const TextureImage& image, int x, int y) {
  const auto channels = static_cast<size_t>(image.channels);
  const uint8_t* t = &image.texels[(static_cast<size_t>(y) * static_cast<size_t>(image.width) +
                                    static_cast<size_t>(x)) *
                                   channels];
  const auto colour = [&](size_t c) { return image.srgb ? kSrgbToLinear[t[c]] : linear(t[c]); };
  switch (channels) {
    case 1:
      return Vec4(Vec3(colour(0)), 1.0f);
    case 2:
      return Vec4(Vec3(colour(0)), linear(t[1]));
    case 3:
      return Vec4(colour(0), colour(1), colour(2), 1.0f);
    default:
      return Vec4(colour(0), colour(1), colour(2), linear(t[3]));
  }
}

Vec4 bilinear(const TextureImage& image, const TextureUse& use, float x, float y) {
  const float x0 = std::floor(x - 0.5f), y0 = std::floor(y - 0.5f);
  const float fx = x - 0.5f - x0, fy = y - 0.5f - y0;
  const int ix = static_cast<int>(x0), iy = static_cast<int>(y0);
  const int left = wrapTexel(ix, image.width, use.wrapS);
  const int right = wrapTexel(ix + 1, image.width, use.wrapS);
  const int top = wrapTexel(iy, image.height, use.wrapT);
  const int bottom = wrapTexel(iy + 1, image.height, use.wrapT);
  const Vec4 upper = (1 - fx) * texel(image, left, top) + fx * texel(image, right, top);
  const Vec4 lower = (1 - fx) * texel(image, left, bottom) + fx * texel(image, right, bottom);
  return (1 - fy) * upper + fy * lower;
}

}  // namespace

Vec4 texelOf(const TextureImage& image, int x, int y) { return texel(image, x, y); }

int wrapTexel(int i, int size, Wrap wrap) {
  if (i >= 0 && i < size) return i;  // nearly always, and divisions are slow
  if (wrap == Wrap::clamp) return std::clamp(i, 0, size - 1);
  const int period = wrap == Wrap::mirror ? 2 * size : size;
  const int r = ((i % period) + period) % period;
  return r < size ? r : period - 1 - r;
}

Vec2 textureCoordinates(const TextureUse& use, Vec2 uv) {
  const Vec2 s = use.scale * uv;
  if (use.rotation == 0) return s + use.offset;
  const float c = std::cos(use.rotation), n = std::sin(use.rotation);
  return Vec2(c * s.x + n * s.y, c * s.y - n * s.x) + use.offset;
}

Vec4 lookUp(const Scene& scene, const TextureUse& use, Vec2 uv0, Vec2 uv1) {
  const TextureImage& image = scene.images[static_cast<size_t>(use.image)];
  const Vec2 uv = textureCoordinates(use, use.uvSet == 0 ? uv0 : uv1);
  const float x = fold(uv.x, use.wrapS) * static_cast<float>(image.width);
  const float y = fold(uv.y, use.wrapT) * static_cast<float>(image.height);
  if (!use.nearest) return bilinear(image, use, x, y);
  return texelOf(image, wrapTexel(static_cast<int>(x), image.width, use.wrapS),
                 wrapTexel(static_cast<int>(y), image.height, use.wrapT));
}

}  // namespace ninefold
