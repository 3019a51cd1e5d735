#include "common/image/denoise_planes.h"

#include <algorithm>
#include <cmath>

#include "common/base/error.h"

namespace ninefold {
namespace {

constexpr float kNearness = 0.03f;
constexpr float kDoubt = 2;
constexpr int kLevelReach = 3;  // of g

// Mean over (2 reach + 1)^2 pixels, as many as lie in the picture. In two passes.
std::vector<float> blurred(const std::vector<float>& in, int width, int height, int reach) {
  std::vector<float> rows(in.size()), out(in.size());
  for (int y = 0; y < height; ++y) {
    const size_t row = pixelCount(width, y);
    for (int x = 0; x < width; ++x) {
      const int from = std::max(0, x - reach), to = std::min(width - 1, x + reach);
      float sum = 0;
      for (int i = from; i <= to; ++i) sum += in[row + static_cast<size_t>(i)];
      rows[row + static_cast<size_t>(x)] = sum / static_cast<float>(to - from + 1);
    }
  }
  for (int y = 0; y < height; ++y) {
    const int from = std::max(0, y - reach), to = std::min(height - 1, y + reach);
    const float share = 1 / static_cast<float>(to - from + 1);
    float* sums = &out[pixelCount(width, y)];
    for (int j = from; j <= to; ++j) {
      const float* row = &rows[pixelCount(width, j)];
      for (int x = 0; x < width; ++x) sums[x] += row[x] * share;
    }
  }
  return out;
}

// Copies a plane of the picture into one with a border, whose pixels are the nearest ones.
void pad(const DenoisePlanes& planes, const std::vector<float>& from, std::vector<float>& to) {
  const int w = planes.width, h = planes.height, border = DenoisePlanes::kBorder;
  to.resize(pixelCount(planes.stride, h + 2 * border));
  for (int y = -border; y < h + border; ++y) {
    const float* row = &from[pixelCount(w, std::clamp(y, 0, h - 1))];
    float* out = &to[planes.at(0, y)];
    std::copy_n(row, w, out);
    std::fill(out - border, out, row[0]);
    std::fill(out + w, out - border + planes.stride, row[w - 1]);
  }
}

void pad(const DenoisePlanes& planes, const RgbPlane& from, RgbPlane& to) {
  pad(planes, from.r, to.r), pad(planes, from.g, to.g), pad(planes, from.b, to.b);
}

// Of a plane at pixel i, whose neighbours are `step` apart: the smaller one of two differences, so
// that an edge on one side does not count. hasBefore, hasAfter: they are in the picture.
float slope(const std::vector<float>& plane, size_t i, size_t step, bool hasBefore, bool hasAfter) {
  const float before = plane[i] - plane[i - step], after = plane[i + step] - plane[i];
  if (!hasBefore) return after;
  return !hasAfter || std::abs(before) < std::abs(after) ? before : after;
}

}  // namespace

DenoisePlanes::DenoisePlanes(const RgbImage& picture, const std::vector<float>& standardError,
                             const DenoiseGuides& guides)
    : width(picture.width), height(picture.height), stride(picture.width + 2 * kBorder) {
  const size_t n = picture.count();
  for (const std::vector<float>* plane :
       {&standardError, &guides.albedo, &guides.nearness, &guides.normal.r})
    NINEFOLD_CHECK(plane->size() == n);
  std::vector<float> squared(n), v(n);
  RgbPlane finite = picture.pixels;
  for (size_t i = 0; i < n; ++i) {
    const Vec3 c = picture.rgb(i);
    if (!isFinite(c) || !std::isfinite(standardError[i])) {
      finite.r[i] = finite.g[i] = finite.b[i] = 0, squared[i] = -1;
      continue;
    }
    squared[i] = standardError[i] * standardError[i];
    const float y = luminance(c);
    const Vec3 hue = y > 0 ? c / y : Vec3(1);
    v[i] = squared[i] * glm::dot(hue, hue);
  }
  pad(*this, finite, color);
  pad(*this, guides.normal, normal);
  pad(*this, blurred(v, width, height, 1), variance);
  pad(*this, guides.albedo, albedo);
  pad(*this, guides.nearness, nearness);
  fillTrust(squared);
  fillSlopes();
}

// squaredError: -1 where the pixel is not finite.
void DenoisePlanes::fillTrust(const std::vector<float>& squaredError) {
  constexpr float kLeast = 1e-30f;  // has a logarithm
  std::vector<float> level(squaredError.size());
  for (size_t i = 0; i < level.size(); ++i) level[i] = std::log(std::max(squaredError[i], kLeast));
  level = blurred(level, width, height, kLevelReach);
  trust.assign(color.r.size(), 0);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const size_t i = pixelCount(width, y) + static_cast<size_t>(x);
      if (squaredError[i] >= 0)
        trust[at(x, y)] = 1 / (1 + kDoubt * squaredError[i] / std::exp(level[i]));
    }
}

void DenoisePlanes::fillSlopes() {
  for (auto* plane : {&slopeX, &slopeY, &perZ}) plane->assign(nearness.size(), 0);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const size_t i = at(x, y), row = static_cast<size_t>(stride);
      const float z = nearness[i];
      slopeX[i] = slope(nearness, i, 1, x > 0, x + 1 < width);
      slopeY[i] = slope(nearness, i, row, y > 0, y + 1 < height);
      perZ[i] = 1 / (kNearness * std::max(z, 1e-6f));
    }
}

}  // namespace ninefold
