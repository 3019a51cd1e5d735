#include "common/scene/texel_maps.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/scene/texture.h"

namespace ninefold {
namespace {

// Not-a-number becomes 0.
uint8_t code(float value) {
  return static_cast<uint8_t>(std::lround(value > 0 ? 255 * std::min(value, 1.0f) : 0.0f));
}

// IEC 61966-2-1.
float srgbEncoded(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

// An image whose texels are `codesOf(x, y)`, one code for each channel.
template <size_t channels, typename CodesOf>
TextureImage made(int width, int height, const CodesOf& codesOf) {
  TextureImage image;
  image.width = width, image.height = height, image.channels = static_cast<int>(channels);
  image.texels.reserve(channels * static_cast<size_t>(width) * static_cast<size_t>(height));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::array<uint8_t, channels> codes = codesOf(x, y);
      image.texels.insert(image.texels.end(), codes.begin(), codes.end());
    }
  return image;
}

float channelOf(Vec4 t, char channel) {
  switch (channel) {
    case 'r':
      return t.x;
    case 'g':
      return t.y;
    case 'b':
      return t.z;
    case 'm':
      return t.w;
    default:
      return glm::dot(Vec3(t), Vec3(0.2126f, 0.7152f, 0.0722f));
  }
}

// The texel nearest to texel (x, y) of an image of this width and height.
Vec4 nearest(const TextureImage& image, int x, int y, int width, int height) {
  const auto at = [](int i, int size, int of) {
    return static_cast<int>(static_cast<int64_t>(i) * size / of);
  };
  return texelOf(image, at(x, image.width, width), at(y, image.height, height));
}

float heightAt(const TextureImage& image, int x, int y, Wrap wrap) {
  return texelOf(image, wrapTexel(x, image.width, wrap), wrapTexel(y, image.height, wrap)).x;
}

std::array<uint8_t, 3> normalCodes(Vec3 n) {
  const Vec3 c = 0.5f * (glm::normalize(n) + Vec3(1));
  return {code(c.x), code(c.y), code(c.z)};
}

}  // namespace

TextureImage scalarOf(const TextureImage& image, char channel, Gain gain) {
  return made<1>(image.width, image.height, [&](int x, int y) {
    return std::array{code(gain.base + gain.gain * channelOf(texelOf(image, x, y), channel))};
  });
}

char coverageChannel(const TextureImage& image) {
  if (image.channels == 1 || image.channels == 3) return 'l';
  const auto channels = static_cast<size_t>(image.channels);
  for (size_t i = channels - 1; i < image.texels.size(); i += channels)
    if (image.texels[i] != 255) return 'm';
  return 'l';
}

TextureImage coloursOf(const TextureImage& image, char channel, Gain gain) {
  const auto colour = [&](int x, int y) {
    const Vec4 t = texelOf(image, x, y);
    return channel == 0 ? Vec3(t) : Vec3(channelOf(t, channel));
  };
  if (gain.isIdentity())
    return made<3>(image.width, image.height, [&](int x, int y) {
      const Vec3 c = colour(x, y);
      return std::array{code(c.x), code(c.y), code(c.z)};
    });
  const auto changed = [&](float c) {
    const float linear = c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
    return code(srgbEncoded(std::clamp(gain.base + gain.gain * linear, 0.0f, 1.0f)));
  };
  return made<3>(image.width, image.height, [&](int x, int y) {
    const Vec3 c = colour(x, y);
    return std::array{changed(c.x), changed(c.y), changed(c.z)};
  });
}

TextureImage coveredBy(const TextureImage& colours, const TextureImage& coverage) {
  const int width = std::max(colours.width, coverage.width);
  const int height = std::max(colours.height, coverage.height);
  return made<4>(width, height, [&](int x, int y) {
    const Vec4 c = nearest(colours, x, y, width, height);
    return std::array{code(c.x), code(c.y), code(c.z),
                      code(nearest(coverage, x, y, width, height).x)};
  });
}

TextureImage asSeenBy(const TextureUse& use, const TextureImage& image) {
  const auto side = [](float scale, int size) {
    return std::max(1, static_cast<int>(std::abs(scale) * static_cast<float>(size)));
  };
  TextureImage seen;
  seen.width = side(use.scale.x, image.width), seen.height = side(use.scale.y, image.height);
  seen.channels = image.channels;
  const auto channels = static_cast<size_t>(image.channels);
  for (int y = 0; y < seen.height; ++y)
    for (int x = 0; x < seen.width; ++x) {
      const Vec2 uv = (Vec2(x, y) + 0.5f) / Vec2(seen.width, seen.height);
      const Vec2 at = glm::fract(textureCoordinates(use, uv)) * Vec2(image.width, image.height);
      const int column = std::min(static_cast<int>(at.x), image.width - 1);
      const int row = std::min(static_cast<int>(at.y), image.height - 1);
      const auto texel = image.texels.begin() +
                         (static_cast<ptrdiff_t>(row) * image.width + column) * image.channels;
      seen.texels.insert(seen.texels.end(), texel, texel + static_cast<ptrdiff_t>(channels));
    }
  return seen;
}

TextureImage metallicRoughness(const TextureImage* roughness, const TextureImage* metallic) {
  const auto side = [&](int TextureImage::*size) {
    return std::max(roughness ? roughness->*size : 1, metallic ? metallic->*size : 1);
  };
  const int width = side(&TextureImage::width), height = side(&TextureImage::height);
  const auto value = [&](const TextureImage* image, int x, int y) {
    return image == nullptr ? uint8_t{255} : code(nearest(*image, x, y, width, height).x);
  };
  return made<3>(width, height, [&](int x, int y) {
    return std::array{uint8_t{255}, value(roughness, x, y), value(metallic, x, y)};
  });
}

TextureImage normalsOfHeights(const TextureImage& heights, float strength, Wrap wrap) {
  return made<3>(heights.width, heights.height, [&](int x, int y) {
    const float right = heightAt(heights, x + 1, y, wrap) - heightAt(heights, x - 1, y, wrap);
    const float up = heightAt(heights, x, y - 1, wrap) - heightAt(heights, x, y + 1, wrap);
    return normalCodes(Vec3(-0.5f * strength * right, -0.5f * strength * up, 1));
  });
}

bool isNormalMap(const TextureImage& image) {
  if (image.channels < 3) return false;
  const auto channels = static_cast<size_t>(image.channels);
  size_t blue = 0;
  for (size_t i = 0; i < image.texels.size(); i += channels) {
    const uint8_t* t = &image.texels[i];
    blue += t[2] > t[0] && t[2] > t[1] ? 1 : 0;
  }
  return 10 * blue * channels > 9 * image.texels.size();
}

TextureImage scaledNormals(const TextureImage& normals, float strength) {
  if (strength == 1) return normals;
  return made<3>(normals.width, normals.height, [&](int x, int y) {
    const Vec3 n = 2.0f * Vec3(texelOf(normals, x, y)) - Vec3(1);
    return normalCodes(Vec3(strength * n.x, strength * n.y, std::max(n.z, 1e-3f)));
  });
}

}  // namespace ninefold
