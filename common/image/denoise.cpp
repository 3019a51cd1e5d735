#include "common/image/denoise.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <thread>

#include "common/base/vectors.h"
#include "common/image/denoise_planes.h"

namespace ninefold {
namespace {

constexpr int kReach = 5;  // of the window
constexpr int kSide = 2 * kReach + 1, kWindow = kSide * kSide;
constexpr float kNormal = 0.4f, kAlbedo = 0.4f;
constexpr float kAlbedoRidge = 0.003f, kPlaceRidge = 0.01f;
constexpr int kStripWidth = 64, kBandHeight = 60;  // pixels that one thread does at a time
constexpr int kPatchRows = 3;
constexpr float kTiny = 1e-30f;

static_assert(DenoisePlanes::kBorder >= kReach + 1 + kLanes);

Floats all(float value) { return Floats{} + value; }

// The sums of the regression over the window, for kLanes pixels. Feature 0 is albedo, 1 and 2 the
// place; colours are differences from the pixel's own.
struct Sums {
  Floats weight{}, feature[3]{}, square[6]{};  // square: 00 01 02 11 12 22
  Floats color[3]{}, product[3][3]{};          // product[colour][feature]

  void add(Floats w, const std::array<Floats, 3>& f, const std::array<Floats, 3>& c) {
    weight += w;
    const Floats wf[3] = {w * f[0], w * f[1], w * f[2]};
    for (int i = 0; i < 3; ++i) feature[i] += wf[i];
    square[0] += wf[0] * f[0], square[1] += wf[0] * f[1], square[2] += wf[0] * f[2];
    square[3] += wf[1] * f[1], square[4] += wf[1] * f[2], square[5] += wf[2] * f[2];
    for (int k = 0; k < 3; ++k) {
      color[k] += w * c[k];
      for (int i = 0; i < 3; ++i) product[k][i] += wf[i] * c[k];
    }
  }

  // b0 less the pixel's own colour: the mean difference, less what features explain of it. By
  // Cramer's rule: the ridge keeps the determinant above 0.
  std::array<Floats, 3> solve() const {
    const Floats share = 1.0f / largest(weight, all(kTiny));
    const Floats f[3] = {feature[0] * share, feature[1] * share, feature[2] * share};
    const Floats a = square[0] * share - f[0] * f[0] + kAlbedoRidge,
                 b = square[1] * share - f[0] * f[1], c = square[2] * share - f[0] * f[2],
                 d = square[3] * share - f[1] * f[1] + kPlaceRidge,
                 e = square[4] * share - f[1] * f[2],
                 g = square[5] * share - f[2] * f[2] + kPlaceRidge;
    const Floats m00 = d * g - e * e, m01 = c * e - b * g, m02 = b * e - c * d;
    const Floats m11 = a * g - c * c, m12 = b * c - a * e, m22 = a * d - b * b;
    const Floats determinant = a * m00 + b * m01 + c * m02;
    // Row f^T M^-1: what a covariance with each feature is worth.
    const Floats scale = 1.0f / determinant;
    const Floats worth[3] = {(f[0] * m00 + f[1] * m01 + f[2] * m02) * scale,
                             (f[0] * m01 + f[1] * m11 + f[2] * m12) * scale,
                             (f[0] * m02 + f[1] * m12 + f[2] * m22) * scale};
    std::array<Floats, 3> out;
    for (size_t k = 0; k < 3; ++k) {
      const Floats mean = color[k] * share;
      Floats explained{};
      for (int i = 0; i < 3; ++i) explained += worth[i] * (product[k][i] * share - f[i] * mean);
      out[k] = mean - explained;
    }
    return out;
  }
};

// What one thread needs for a strip, and the strip's way down a band.
class Strip {
 public:
  Strip(const DenoisePlanes& planes, const std::vector<float>& standardError, RgbImage& picture)
      : p_(planes),
        error_(standardError),
        picture_(picture),
        distances_(static_cast<size_t>(kWindow * kPatchRows * kStripWidth)) {}

  void run(int x0, int y0) {
    const int y1 = std::min(y0 + kBandHeight, p_.height);
    measure(x0, y0 - 1), measure(x0, y0);
    for (int y = y0; y < y1; ++y) {
      measure(x0, y + 1);
      for (int x = x0; x < std::min(x0 + kStripWidth, p_.width); x += kLanes) finish(x, y, x - x0);
    }
  }

 private:
  float* distances(int neighbour, int y) {
    const int row = (y + kPatchRows) % kPatchRows;
    return &distances_[static_cast<size_t>((neighbour * kPatchRows + row) * kStripWidth)];
  }

  // Distances of the row's pixels to their neighbours, summed over three pixels side by side.
  void measure(int x0, int y) {
    constexpr int kWidth = kStripWidth + 2 * kLanes;
    std::array<float, kWidth> row;
    int neighbour = 0;
    for (int dy = -kReach; dy <= kReach; ++dy)
      for (int dx = -kReach; dx <= kReach; ++dx, ++neighbour) {
        const size_t here = p_.at(x0, y) - kLanes, there = p_.at(x0 + dx, y + dy) - kLanes;
        for (size_t i = 0; i < kWidth; i += kLanes) put(distance(here + i, there + i), &row[i]);
        float* out = distances(neighbour, y);
        for (size_t i = 0; i < kStripWidth; i += kLanes)
          put(floatsAt(&row[i + kLanes - 1]) + floatsAt(&row[i + kLanes]) +
                  floatsAt(&row[i + kLanes + 1]),
              out + i);
      }
  }

  Floats distance(size_t i, size_t j) const {
    const RgbPlane& c = p_.color;
    const Floats r = floatsAt(&c.r[i]) - floatsAt(&c.r[j]),
                 g = floatsAt(&c.g[i]) - floatsAt(&c.g[j]),
                 b = floatsAt(&c.b[i]) - floatsAt(&c.b[j]);
    const Floats vi = floatsAt(&p_.variance[i]), vj = floatsAt(&p_.variance[j]);
    return (r * r + g * g + b * b - (vi + least(vi, vj))) / (vi + vj + kTiny);
  }

  // w of neighbours j of pixels i.
  Floats weight(size_t i, size_t j, float dx, float dy, Floats patches, Floats albedo) const {
    const RgbPlane& n = p_.normal;
    const Floats x = floatsAt(&n.r[i]) - floatsAt(&n.r[j]),
                 y = floatsAt(&n.g[i]) - floatsAt(&n.g[j]),
                 z = floatsAt(&n.b[i]) - floatsAt(&n.b[j]);
    const Floats off = (floatsAt(&p_.nearness[j]) - floatsAt(&p_.nearness[i]) -
                        floatsAt(&p_.slopeX[i]) * dx - floatsAt(&p_.slopeY[i]) * dy) *
                       floatsAt(&p_.perZ[i]);
    const Floats guides = (x * x + y * y + z * z) * (0.5f / (kNormal * kNormal)) +
                          off * off * 0.5f + albedo * albedo * (0.5f / (kAlbedo * kAlbedo));
    const Floats far = largest(patches, Floats{}) * (1.0f / 9) + guides;
    Floats w = largest(1.0f - far * 0.125f, Floats{});
    w *= w, w *= w, w *= w;
    return w * floatsAt(&p_.trust[j]);
  }

  void finish(int x, int y, int inStrip) {
    const size_t i = p_.at(x, y);
    const RgbPlane& c = p_.color;
    const Floats r = floatsAt(&c.r[i]), g = floatsAt(&c.g[i]), b = floatsAt(&c.b[i]),
                 albedo = floatsAt(&p_.albedo[i]);
    Sums sums;
    int neighbour = 0;
    for (int dy = -kReach; dy <= kReach; ++dy)
      for (int dx = -kReach; dx <= kReach; ++dx, ++neighbour) {
        const size_t j = p_.at(x + dx, y + dy);
        const Floats patches = floatsAt(distances(neighbour, y - 1) + inStrip) +
                               floatsAt(distances(neighbour, y) + inStrip) +
                               floatsAt(distances(neighbour, y + 1) + inStrip);
        const auto fx = static_cast<float>(dx), fy = static_cast<float>(dy);
        const Floats da = floatsAt(&p_.albedo[j]) - albedo;
        const Floats w = weight(i, j, fx, fy, patches, da);
        sums.add(w, {da, all(fx / kReach), all(fy / kReach)},
                 {floatsAt(&c.r[j]) - r, floatsAt(&c.g[j]) - g, floatsAt(&c.b[j]) - b});
      }
    const std::array<Floats, 3> step = sums.solve();
    for (int lane = 0; lane < std::min(kLanes, p_.width - x); ++lane)
      move(picture_.at(x + lane, y), {step[0][lane], step[1][lane], step[2][lane]});
  }

  // c', never darker than black.
  void move(size_t pixel, Vec3 step) {
    const float error = error_[pixel], off = std::abs(luminance(step));
    const Vec3 c = picture_.rgb(pixel);
    const Vec3 to = c + (off > error ? error / off : 1.0f) * step;
    if (!(error > 0) || !std::isfinite(luminance(to))) return;
    picture_.pixels.r[pixel] = std::max(to.x, std::min(c.x, 0.0f));
    picture_.pixels.g[pixel] = std::max(to.y, std::min(c.y, 0.0f));
    picture_.pixels.b[pixel] = std::max(to.z, std::min(c.z, 0.0f));
  }

  const DenoisePlanes& p_;
  const std::vector<float>& error_;
  RgbImage& picture_;
  std::vector<float> distances_;  // by neighbour, row mod 3 and column
};

}  // namespace

bool denoise(RgbImage& picture, const std::vector<float>& standardError,
             const DenoiseGuides& guides, int threads, const std::stop_token& stop) {
  if (std::ranges::none_of(standardError, [](float e) { return e > 0; })) return true;
  const DenoisePlanes planes(picture, standardError, guides);
  const int columns = (picture.width + kStripWidth - 1) / kStripWidth,
            rows = (picture.height + kBandHeight - 1) / kBandHeight;
  std::atomic<int> next{0};
  const auto work = [&] {
    Strip strip(planes, standardError, picture);
    for (int i = next++; i < columns * rows && !stop.stop_requested(); i = next++)
      strip.run(i % columns * kStripWidth, i / columns * kBandHeight);
  };
  {
    std::vector<std::jthread> others;
    for (int i = 1; i < threads; ++i) others.emplace_back(work);
    work();
  }
  return !stop.stop_requested();
}

}  // namespace ninefold
