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

// Guides of a row of the patch whose pixel i looks along v0 + (i0 + i) step: i0 + i is its place in
// the whole row of the sub-plane, so that all patches agree to the last bit.
void guideRow(const ImagePlane& plane, Vec3 v0, Vec3 step, int i0, size_t first,
              const LayerPlanes& layer, GuidePlanes& guides) {
  const float *nx = layer.normal.r.data() + first, *ny = layer.normal.g.data() + first,
              *nz = layer.normal.b.data() + first, *distance = layer.distance.data() + first;
  float *u = guides.u.data() + first, *gradX = guides.gradX.data() + first,
        *gradY = guides.gradY.data() + first, *slack = guides.slack.data() + first;
#pragma GCC ivdep
  for (int i = 0; i < Patch::kSide; ++i) {
    const Vec3 v = v0 + static_cast<float>(i0 + i) * step;
    const SurfaceGuide guide = guideOf(plane, v, Vec3(nx[i], ny[i], nz[i]), distance[i]);
    u[i] = guide.u, gradX[i] = guide.gradX, gradY[i] = guide.gradY, slack[i] = guide.slack;
  }
}

// A position of the window as seen from one phase: which phase lies there, and where its sub-pixels
// are.
struct Neighbour {
  int dx, dy;  // in pixels
  int phase;
  int shift;  // pixel i of the centre's plane has pixel i + shift of the other as neighbour
};

Neighbour neighbourAt(Interleave pattern, int phase, int dx, int dy) {
  // dx > -n, so that adding n keeps both quotients of a positive number.
  const int px = phase % pattern.n + dx + pattern.n, py = phase / pattern.n + dy + pattern.m;
  return {dx, dy, px % pattern.n + pattern.n * (py % pattern.m),
          (py / pattern.m - 1) * Patch::kSide + px / pattern.n - 1};
}

// One layer of a phase, from its pixel `first` on.
struct Row {
  const float *r, *g, *b;  // E
  const float *nx, *ny, *nz, *distance;
  const uint16_t* chain;
  const float *u, *gradX, *gradY, *slack;  // null without guides

  SurfaceGuide guide(int i) const { return {u[i], gradX[i], gradY[i], slack[i]}; }
};

Row rowOf(const LayerPlanes& planes, const GuidePlanes* guides, int first) {
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

// Sums over the window, for `count` pixels of a phase.
struct Sums {
  int count;
  float weight[kChunk], r[kChunk], g[kChunk], b[kChunk];
};

// value or 0, without a branch and without 0 * infinity: what is not finite must not cross edges.
float masked(float value, uint32_t mask) {
  return std::bit_cast<float>(std::bit_cast<uint32_t>(value) & mask);
}

// Adds one window position: w and w (E_i - E_0), w = weight where accept(i) says that the surface
// goes on from centre[i] to other[i], else 0.
template <typename Accept>
void addPosition(const Row& centre, const Row& other, float weight, Accept accept, Sums& sums) {
#pragma GCC ivdep
  for (int i = 0; i < sums.count; ++i) {
    const uint32_t mask = accept(i) ? ~0u : 0u;
    sums.weight[i] += masked(weight, mask);
    sums.r[i] += masked(weight * (other.r[i] - centre.r[i]), mask);
    sums.g[i] += masked(weight * (other.g[i] - centre.g[i]), mask);
    sums.b[i] += masked(weight * (other.b[i] - centre.b[i]), mask);
  }
}

float cosine(const Row& p, const Row& q, int i) {
  return p.nx[i] * q.nx[i] + p.ny[i] * q.ny[i] + p.nz[i] * q.nz[i];
}

struct Limits {
  float distance, normal;
};

void addByTangentPlanes(const Row& p, const Row& q, const Neighbour& at, float weight, Sums& sums) {
  const float dx = static_cast<float>(at.dx), dy = static_cast<float>(at.dy);
  const auto accept = [&](int i) {
    return bool(int(cosine(p, q, i) >= kSurfaceNormal) &
                int(predictsNeighbour(p.guide(i), q.guide(i), dx, dy)));
  };
  addPosition(p, q, weight, accept, sums);
}

void addByLimits(const Row& p, const Row& q, Limits limits, float weight, Sums& sums) {
  const auto accept = [&](int i) {
    return bool(int(p.chain[i] == q.chain[i]) & int(cosine(p, q, i) >= limits.normal) &
                int(similarDistance(p.distance[i], q.distance[i], limits.distance)));
  };
  addPosition(p, q, weight, accept, sums);
}

void finish(const Row& centre, const Sums& sums, float* r, float* g, float* b) {
#pragma GCC ivdep
  for (int i = 0; i < sums.count; ++i) {
    r[i] = centre.r[i] + sums.r[i] / sums.weight[i];
    g[i] = centre.g[i] + sums.g[i] / sums.weight[i];
    b[i] = centre.b[i] + sums.b[i] / sums.weight[i];
  }
}

Limits limitsOf(SurfaceTest test) {
  return test == SurfaceTest::paper ? Limits{kPaperDistance, kPaperNormal}
                                    : Limits{kMirrorDistance, kMirrorNormal};
}

void start(int count, Sums& sums) {
  sums.count = count;
  std::fill_n(sums.weight, count, 1.0f);
  for (float* sum : {sums.r, sums.g, sums.b}) std::fill_n(sum, count, 0.0f);
}

}  // namespace

void DiscontinuityBuffer::guide(const Patch& patch, const Camera& camera) {
  if (test_ != SurfaceTest::surface || patch.isDark(kDiffuse)) return;
  const TileGrid& grid = patch.grid();
  const ImagePlane plane(camera, grid.width(), grid.height());
  const Vec3 step = static_cast<float>(grid.interleave().n) * plane.stepX;
  guides_.resize(static_cast<size_t>(patch.phases()));
  for (int phase = 0; phase < patch.phases(); ++phase) {
    GuidePlanes& guides = guides_[static_cast<size_t>(phase)];
    guides.resize(Patch::kPixels);
    const TaskRect& inner = patch.inner(phase);
    for (int j = 0; j < inner.height + 2; ++j) {
      const float px = static_cast<float>(grid.pixelX(phase, 0)) + 0.5f;
      const float py = static_cast<float>(grid.pixelY(phase, inner.j0 - 1 + j)) + 0.5f;
      guideRow(plane, plane.corner + px * plane.stepX + py * plane.stepY, step, inner.i0 - 1,
               static_cast<size_t>(j * Patch::kSide), patch.phase(phase).layers[kDiffuse], guides);
    }
  }
}

template <typename Take>
void DiscontinuityBuffer::sum(const Patch& patch, int layer, int phase, float weight,
                              const Take& take) const {
  const TaskRect& inner = patch.inner(phase);
  if (inner.count() == 0) return;
  const bool planes = layer == kDiffuse && test_ == SurfaceTest::surface;
  const auto rowAt = [&](int p, int from) {
    return rowOf(patch.phase(p).layers[static_cast<size_t>(layer)],
                 planes ? &guides_[static_cast<size_t>(p)] : nullptr, from);
  };
  const Interleave pattern = patch.grid().interleave();
  const Interleave window = test_ == SurfaceTest::none ? Interleave{.n = 1, .m = 1} : pattern;
  const int end = inner.height * Patch::kSide + inner.width + 1;
  for (int first = Patch::kSide + 1; first < end; first += kChunk) {
    const Row centre = rowAt(phase, first);
    Sums sums;
    start(std::min(kChunk, end - first), sums);
    for (int dy = -(window.m - 1) / 2; dy <= window.m / 2; ++dy)
      for (int dx = -(window.n - 1) / 2; dx <= window.n / 2; ++dx) {
        if (dx == 0 && dy == 0) continue;
        const Neighbour at = neighbourAt(pattern, phase, dx, dy);
        const Row other = rowAt(at.phase, first + at.shift);
        if (planes)
          addByTangentPlanes(centre, other, at, weight, sums);
        else
          addByLimits(centre, other, limitsOf(test_), weight, sums);
      }
    take(static_cast<size_t>(first), centre, sums);
  }
}

void DiscontinuityBuffer::filter(const Patch& patch, int layer, int phase, float neighbourWeight,
                                 RgbPlane& out) const {
  sum(patch, layer, phase, neighbourWeight, [&](size_t first, const Row& centre, const Sums& sums) {
    finish(centre, sums, &out.r[first], &out.g[first], &out.b[first]);
  });
}

void DiscontinuityBuffer::shares(const Patch& patch, int layer, int phase, float neighbourWeight,
                                 std::vector<float>& out) const {
  const auto sets = static_cast<float>(patch.phases());
  out.assign(Patch::kPixels, 0);
  sum(patch, layer, phase, neighbourWeight, [&](size_t first, const Row&, const Sums& sums) {
    for (int i = 0; i < sums.count; ++i)
      out[first + static_cast<size_t>(i)] = sums.weight[i] / sets;
  });
}

}  // namespace ninefold
