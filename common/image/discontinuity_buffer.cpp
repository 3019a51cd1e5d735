#include "common/image/discontinuity_buffer.h"

#include <bit>

#include "common/base/error.h"
#include "common/image/image.h"

namespace ninefold {
namespace {

constexpr int kChunk = 256;  // pixels summed at a time, on the stack

// The camera as v(px, py) = corner + px stepX + py stepY, with depth 1 along the forward axis.
struct ImagePlane {
  Vec3 corner, stepX, stepY;
  float footprint;  // side of a pixel at depth 1 [m]

  ImagePlane(const Camera& camera, int width, int height) {
    const CameraRays rays(camera, width, height);
    const float w = static_cast<float>(width), h = static_cast<float>(height);
    const auto atDepth1 = [&](float px, float py) {
      const Vec3 direction = rays.direction(px, py);
      return direction / glm::dot(direction, camera.forward);
    };
    corner = atDepth1(0, 0);
    stepX = (atDepth1(w, 0) - corner) / w;
    stepY = (atDepth1(0, h) - corner) / h;
    footprint = glm::length(stepY);
  }
};

// See surface_test.h. n is turned towards the eye, so n . v < 0.
SurfaceGuide guideOf(const ImagePlane& plane, Vec3 v, Vec3 n, float d) {
  const float length = std::sqrt(glm::dot(v, v));
  // No test of d itself: the compiler would make it a branch and not vectorise.
  const float inverse = length / std::max(d, 1e-30f);
  const float u = inverse < 1e20f ? inverse : 0.0f;
  const float slope = u / std::min(glm::dot(n, v), -kGrazingCosine * length);
  const float gradX = slope * glm::dot(n, plane.stepX), gradY = slope * glm::dot(n, plane.stepY);
  const float slack = std::abs(gradX) + std::abs(gradY) + kFootprints * plane.footprint * u;
  return {u, gradX, gradY, slack};
}

// Guides of a row whose pixels look along v0, v0 + step, ...
void guideRow(const ImagePlane& plane, Vec3 v0, Vec3 step, int width, size_t first,
              const LayerPlanes& layer, GuidePlanes& guides) {
  const float *nx = layer.normal.r.data() + first, *ny = layer.normal.g.data() + first,
              *nz = layer.normal.b.data() + first, *distance = layer.distance.data() + first;
  float *u = guides.u.data() + first, *gradX = guides.gradX.data() + first,
        *gradY = guides.gradY.data() + first, *slack = guides.slack.data() + first;
#pragma GCC ivdep
  for (int i = 0; i < width; ++i) {
    const Vec3 v = v0 + static_cast<float>(i) * step;
    const SurfaceGuide guide = guideOf(plane, v, Vec3(nx[i], ny[i], nz[i]), distance[i]);
    u[i] = guide.u, gradX[i] = guide.gradX, gradY[i] = guide.gradY, slack[i] = guide.slack;
  }
}

// A position of the window as seen from one phase: which phase lies there, and where its sub-pixels
// are.
struct Neighbour {
  int dx, dy;  // in pixels
  int phase;
  int di, dj;  // sub-pixel (i, j) of the centre's phase has sub-pixel (i + di, j + dj) as neighbour
};

Neighbour neighbourAt(Interleave pattern, int phase, int dx, int dy) {
  // dx > -n, so that adding n keeps both quotients of a positive number.
  const int px = phase % pattern.n + dx + pattern.n, py = phase / pattern.n + dy + pattern.m;
  return {dx, dy, px % pattern.n + pattern.n * (py % pattern.m), px / pattern.n - 1,
          py / pattern.m - 1};
}

// A row of one layer of a sub-plane.
struct Row {
  const float *r, *g, *b;  // E
  const float *nx, *ny, *nz, *distance;
  const uint16_t* chain;
  const float *u, *gradX, *gradY, *slack;  // null without guides

  SurfaceGuide guide(int i) const { return {u[i], gradX[i], gradY[i], slack[i]}; }
};

Row rowOf(const LayerPlanes& planes, const GuidePlanes* guides, size_t first) {
  const auto row = [first](const auto& plane) { return plane.data() + first; };
  Row out{row(planes.irradiance.r),
          row(planes.irradiance.g),
          row(planes.irradiance.b),
          row(planes.normal.r),
          row(planes.normal.g),
          row(planes.normal.b),
          row(planes.distance),
          row(planes.chain),
          nullptr,
          nullptr,
          nullptr,
          nullptr};
  if (guides != nullptr)
    out.u = row(guides->u), out.gradX = row(guides->gradX), out.gradY = row(guides->gradY),
    out.slack = row(guides->slack);
  return out;
}

// The pixels of the centre's row that have a neighbour at one window position.
struct Span {
  int first, last;
  int shift;  // centre[i] has neighbour other[i + shift]
};

// Sums over the window, for the pixels of a row from `first` on.
struct Sums {
  int first;
  float weight[kChunk], r[kChunk], g[kChunk], b[kChunk];
};

// value or 0, without a branch and without 0 * infinity: what is not finite must not cross edges.
float masked(float value, uint32_t mask) {
  return std::bit_cast<float>(std::bit_cast<uint32_t>(value) & mask);
}

// Adds one window position: w and w (E_i - E_0), w = weight where accept(i, k) says that the
// surface goes on from centre[i] to other[k], else 0.
template <typename Accept>
void addPosition(const Row& centre, const Row& other, Span span, float weight, Accept accept,
                 Sums& sums) {
#pragma GCC ivdep
  for (int i = span.first; i < span.last; ++i) {
    const int k = i + span.shift, s = i - sums.first;
    const uint32_t mask = accept(i, k) ? ~0u : 0u;
    sums.weight[s] += masked(weight, mask);
    sums.r[s] += masked(weight * (other.r[k] - centre.r[i]), mask);
    sums.g[s] += masked(weight * (other.g[k] - centre.g[i]), mask);
    sums.b[s] += masked(weight * (other.b[k] - centre.b[i]), mask);
  }
}

float cosine(const Row& p, int i, const Row& q, int k) {
  return p.nx[i] * q.nx[k] + p.ny[i] * q.ny[k] + p.nz[i] * q.nz[k];
}

struct Limits {
  float distance, normal;
};

void addByTangentPlanes(const Row& p, const Row& q, const Neighbour& at, Span span, float weight,
                        Sums& sums) {
  const float dx = static_cast<float>(at.dx), dy = static_cast<float>(at.dy);
  const auto accept = [&](int i, int k) {
    return bool(int(cosine(p, i, q, k) >= kSurfaceNormal) &
                int(predictsNeighbour(p.guide(i), q.guide(k), dx, dy)));
  };
  addPosition(p, q, span, weight, accept, sums);
}

void addByLimits(const Row& p, const Row& q, Limits limits, Span span, float weight, Sums& sums) {
  const auto accept = [&](int i, int k) {
    return bool(int(p.chain[i] == q.chain[k]) & int(cosine(p, i, q, k) >= limits.normal) &
                int(similarDistance(p.distance[i], q.distance[k], limits.distance)));
  };
  addPosition(p, q, span, weight, accept, sums);
}

void finish(const Row& centre, const Sums& sums, int count, float* r, float* g, float* b) {
#pragma GCC ivdep
  for (int s = 0; s < count; ++s) {
    r[s] = centre.r[sums.first + s] + sums.r[s] / sums.weight[s];
    g[s] = centre.g[sums.first + s] + sums.g[s] / sums.weight[s];
    b[s] = centre.b[sums.first + s] + sums.b[s] / sums.weight[s];
  }
}

Limits limitsOf(SurfaceTest test) {
  return test == SurfaceTest::paper ? Limits{kPaperDistance, kPaperNormal}
                                    : Limits{kMirrorDistance, kMirrorNormal};
}

void start(int first, int count, Sums& sums) {
  sums.first = first;
  std::fill_n(sums.weight, count, 1.0f);
  for (float* sum : {sums.r, sums.g, sums.b}) std::fill_n(sum, count, 0.0f);
}

}  // namespace

void DiscontinuityBuffer::reset(const TileGrid& grid, SurfaceTest test) {
  test_ = test;
  guides_.resize(test == SurfaceTest::surface ? static_cast<size_t>(grid.interleave().sets()) : 0);
  for (size_t p = 0; p < guides_.size(); ++p) {
    const int phase = static_cast<int>(p);
    guides_[p].resize(pixelCount(grid.subWidth(phase), grid.subHeight(phase)));
  }
}

void DiscontinuityBuffer::guideRows(const FrameBuffer& frame, const Camera& camera, int phase,
                                    int j0, int j1) {
  if (guides_.empty()) return;
  const TileGrid& grid = frame.grid();
  const ImagePlane plane(camera, grid.width(), grid.height());
  const TileResult& sub = frame.phase(phase);
  GuidePlanes& guides = guides_[static_cast<size_t>(phase)];
  NINEFOLD_CHECK(guides.u.size() == sub.layers[kDiffuse].distance.size());
  const Vec3 step = static_cast<float>(grid.interleave().n) * plane.stepX;
  for (int j = j0; j < j1; ++j) {
    const float px = static_cast<float>(grid.pixelX(phase, 0)) + 0.5f;
    const float py = static_cast<float>(grid.pixelY(phase, j)) + 0.5f;
    guideRow(plane, plane.corner + px * plane.stepX + py * plane.stepY, step, sub.width,
             pixelCount(sub.width, j), sub.layers[kDiffuse], guides);
  }
}

void DiscontinuityBuffer::filterRows(const FrameBuffer& frame, int layer, int phase, int j0, int j1,
                                     float neighbourWeight, RgbPlane& out) const {
  const int width = frame.phase(phase).width;
  for (int j = j0; j < j1; ++j)
    for (int first = 0; first < width; first += kChunk)
      filterChunk(frame, layer, phase, j, first, std::min(kChunk, width - first), neighbourWeight,
                  out);
}

void DiscontinuityBuffer::filterChunk(const FrameBuffer& frame, int layer, int phase, int j,
                                      int first, int count, float weight, RgbPlane& out) const {
  const bool planes = layer == kDiffuse && test_ == SurfaceTest::surface;
  const auto rowAt = [&](int p, int row) {
    const TileResult& sub = frame.phase(p);
    return rowOf(sub.layers[static_cast<size_t>(layer)],
                 planes ? &guides_[static_cast<size_t>(p)] : nullptr, pixelCount(sub.width, row));
  };
  const Row centre = rowAt(phase, j);
  const Interleave pattern = frame.grid().interleave();
  const Interleave window = test_ == SurfaceTest::none ? Interleave{.n = 1, .m = 1} : pattern;
  Sums sums;
  start(first, count, sums);
  for (int dy = -(window.m - 1) / 2; dy <= window.m / 2; ++dy)
    for (int dx = -(window.n - 1) / 2; dx <= window.n / 2; ++dx) {
      const Neighbour at = neighbourAt(pattern, phase, dx, dy);
      const TileResult& sub = frame.phase(at.phase);
      if ((dx == 0 && dy == 0) || j + at.dj < 0 || j + at.dj >= sub.height) continue;
      const Span span{std::max(first, -at.di), std::min(first + count, sub.width - at.di), at.di};
      const Row other = rowAt(at.phase, j + at.dj);
      if (planes)
        addByTangentPlanes(centre, other, at, span, weight, sums);
      else
        addByLimits(centre, other, limitsOf(test_), span, weight, sums);
    }
  const size_t to = pixelCount(frame.phase(phase).width, j) + static_cast<size_t>(first);
  finish(centre, sums, count, &out.r[to], &out.g[to], &out.b[to]);
}

}  // namespace ninefold
