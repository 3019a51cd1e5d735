#include "common/image/surface_links.h"

namespace ninefold {
namespace {

// Where a pair's bit stands among a pixel's links: planes of words, kBits pairs in each.
constexpr int kBits = 32;
struct Place {
  int at;  // of the first pixel's word
  uint32_t bit;
};
Place placeOf(Interleave pattern, int dx, int dy) {
  const int number = dy * (2 * (pattern.n / 2) + 1) + dx + pattern.n / 2;
  return {number / kBits * Patch::kPixels, 1u << number % kBits};
}
size_t wordsOf(Interleave pattern) {
  return static_cast<size_t>(placeOf(pattern, pattern.n / 2, pattern.m / 2).at + Patch::kPixels);
}

bool isInWindow(Interleave pattern, int dx, int dy) {
  return dx >= -(pattern.n - 1) / 2 && dx <= pattern.n / 2 && dy >= -(pattern.m - 1) / 2 &&
         dy <= pattern.m / 2;
}

// Which phase lies (dx, dy) beside one, and how its plane is shifted.
struct Beside {
  int phase, shift;
};
Beside beside(Interleave pattern, int phase, int dx, int dy) {
  // |dx| <= n, so that adding n keeps both quotients of a number that is not negative.
  const int px = phase % pattern.n + dx + pattern.n, py = phase / pattern.n + dy + pattern.m;
  return {px % pattern.n + pattern.n * (py % pattern.m),
          (py / pattern.m - 1) * Patch::kSide + px / pattern.n - 1};
}

// The camera's view rays v = corner + px turnX + py turnY, with depth 1 along the forward axis, and
// its film. Parallel rays do not turn.
struct ImagePlane {
  bool isParallel;
  Vec3 corner, turnX{0}, turnY{0};
  Vec3 stepX, stepY;  // from pixel to pixel on the film [m], of a pinhole at depth 1
  float footprint;    // side of a pixel there [m]

  ImagePlane(const Camera& camera, int width, int height) : isParallel(isOrthographic(camera)) {
    const CameraRays rays(camera, width, height);
    const float w = static_cast<float>(width), h = static_cast<float>(height);
    const auto onFilm = [&](float px, float py) {
      if (isParallel) return rays.start(px, py);
      const Vec3 direction = rays.direction(px, py);
      return direction / glm::dot(direction, camera.forward);
    };
    corner = onFilm(0, 0);
    stepX = (onFilm(w, 0) - corner) / w;
    stepY = (onFilm(0, h) - corner) / h;
    footprint = glm::length(stepY);
    if (isParallel)
      corner = camera.forward;
    else
      turnX = stepX, turnY = stepY;
  }
};

// See surface_test.h. n is turned towards the eye, so n . v < 0.
SurfaceGuide guideOf(const ImagePlane& plane, Vec3 v, Vec3 n, float d) {
  const float length = std::sqrt(glm::dot(v, v));
  // No test of d itself: the compiler would make it a branch and not vectorise.
  const float inverse = length / std::max(d, 1e-30f);
  const float far = inverse < 1e20f ? inverse : 0.0f;
  const float u = plane.isParallel ? d : far, growth = plane.isParallel ? -1.0f : far;
  const float slope = growth / std::min(glm::dot(n, v), -kGrazingCosine * length);
  const float gradX = slope * glm::dot(n, plane.stepX), gradY = slope * glm::dot(n, plane.stepY);
  const float footprint = plane.footprint * std::abs(growth);
  const float slack = std::abs(gradX) + std::abs(gradY) + kFootprints * footprint;
  return {u, gradX, gradY, slack};
}

// What the test looks at, of one layer of a phase from some pixel on.
struct Row {
  const float *nx, *ny, *nz, *distance;
  const uint16_t* chain;
  Row(const LayerPlanes& planes, int first)
      : nx(planes.normal.r.data() + first),
        ny(planes.normal.g.data() + first),
        nz(planes.normal.b.data() + first),
        distance(planes.distance.data() + first),
        chain(planes.chain.data() + first) {}
};

float cosine(const Row& p, const Row& q, int i) {
  return p.nx[i] * q.nx[i] + p.ny[i] * q.ny[i] + p.nz[i] * q.nz[i];
}

// links[i] |= accept(i) ? bit : 0
template <typename Accept>
void mark(int count, uint32_t bit, uint32_t* links, const Accept& accept) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) links[i] |= accept(i) ? bit : 0;
}

struct Limits {
  float distance, normal;
};
Limits limitsOf(SurfaceTest test) {
  return test == SurfaceTest::paper ? Limits{kPaperDistance, kPaperNormal}
                                    : Limits{kMirrorDistance, kMirrorNormal};
}

}  // namespace

void SurfaceLinks::open(Interleave pattern) {
  const auto phases = static_cast<size_t>(pattern.sets());
  pattern_ = pattern;
  pairs_.clear();
  neighbours_.assign(phases, {});
  for (auto& layer : links_) layer.assign(phases, {});
  if (test_ == SurfaceTest::none) return;
  const int right = pattern.n / 2, down = pattern.m / 2;
  for (int phase = 0; phase < pattern.sets(); ++phase)
    for (int dy = -down; dy <= down; ++dy)
      for (int dx = -right; dx <= right; ++dx) {
        if (dx == 0 && dy == 0) continue;
        const auto [other, shift] = beside(pattern, phase, dx, dy);
        const bool begins = dy > 0 || (dy == 0 && dx > 0), isInside = isInWindow(pattern, dx, dy);
        const auto [at, bit] = begins ? placeOf(pattern, dx, dy) : placeOf(pattern, -dx, -dy);
        if (begins && (isInside || isInWindow(pattern, -dx, -dy)))
          pairs_.push_back({phase, other, shift, at, bit, float(dx), float(dy)});
        if (isInside)
          neighbours_[static_cast<size_t>(phase)].push_back(
              {other, shift, begins ? phase : other, begins ? at : at + shift, bit});
      }
}

void SurfaceLinks::connect(const Patch& patch, const Camera& camera) {
  if (pattern_ != patch.grid().interleave()) open(patch.grid().interleave());
  if (test_ == SurfaceTest::surface && !patch.isDark(kDiffuse)) guide(patch, camera);
  for (int layer = 0; layer < kLayers; ++layer) {
    if (!hasLayer(patch.layerMask(), layer) || patch.isDark(layer)) continue;
    for (auto& links : links_[static_cast<size_t>(layer)]) links.assign(wordsOf(pattern_), 0);
    for (const Pair& pair : pairs_) test(patch, layer, pair);
  }
}

// Each row's pixel i looks along v0 + (i0 + i) step: i0 + i is its place in the whole row of the
// sub-plane, so that all patches agree to the last bit.
void SurfaceLinks::guide(const Patch& patch, const Camera& camera) {
  const TileGrid& grid = patch.grid();
  const ImagePlane plane(camera, grid.width(), grid.height());
  const Vec3 step = static_cast<float>(grid.interleave().n) * plane.turnX;
  guides_.resize(static_cast<size_t>(patch.phases()));
  for (int phase = 0; phase < patch.phases(); ++phase) {
    GuidePlanes& guides = guides_[static_cast<size_t>(phase)];
    guides.resize(Patch::kPixels);
    const TaskRect& inner = patch.inner(phase);
    const LayerPlanes& layer = patch.phase(phase).layers[kDiffuse];
    for (int j = 0; j < inner.height + 2; ++j) {
      const float px = static_cast<float>(grid.pixelX(phase, 0)) + 0.5f;
      const float py = static_cast<float>(grid.pixelY(phase, inner.j0 - 1 + j)) + 0.5f;
      const Vec3 v0 = plane.corner + px * plane.turnX + py * plane.turnY;
      const int first = j * Patch::kSide, i0 = inner.i0 - 1;
      const Row row(layer, first);
      float *u = guides.u.data() + first, *gradX = guides.gradX.data() + first,
            *gradY = guides.gradY.data() + first, *slack = guides.slack.data() + first;
#pragma GCC ivdep
      for (int i = 0; i < Patch::kSide; ++i) {
        const Vec3 v = v0 + static_cast<float>(i0 + i) * step;
        const SurfaceGuide guide =
            guideOf(plane, v, Vec3(row.nx[i], row.ny[i], row.nz[i]), row.distance[i]);
        u[i] = guide.u, gradX[i] = guide.gradX, gradY[i] = guide.gradY, slack[i] = guide.slack;
      }
    }
  }
}

void SurfaceLinks::test(const Patch& patch, int layer, const Pair& pair) {
  const int end = (patch.inner(0).height + 1) * Patch::kSide;  // of the rows where pairs begin
  const int first = std::max(0, -pair.shift);
  const int count = std::min(end, Patch::kPixels - pair.shift) - first;
  uint32_t* links = links_[static_cast<size_t>(layer)][static_cast<size_t>(pair.phase)].data() +
                    pair.linkAt + first;
  const auto rowOf = [&](int phase, int from) {
    return Row(patch.phase(phase).layers[static_cast<size_t>(layer)], from);
  };
  const Row p = rowOf(pair.phase, first), q = rowOf(pair.other, first + pair.shift);
  if (layer == kDiffuse && test_ == SurfaceTest::surface) {
    const auto guidesOf = [&](int phase, int from) {
      const GuidePlanes& g = guides_[static_cast<size_t>(phase)];
      return [u = g.u.data() + from, gradX = g.gradX.data() + from, gradY = g.gradY.data() + from,
              slack = g.slack.data() + from](int i) {
        return SurfaceGuide{u[i], gradX[i], gradY[i], slack[i]};
      };
    };
    const auto guideP = guidesOf(pair.phase, first),
               guideQ = guidesOf(pair.other, first + pair.shift);
    const float dx = pair.dx, dy = pair.dy;
    mark(count, pair.linkBit, links, [=](int i) {
      return bool(int(cosine(p, q, i) >= kSurfaceNormal) &
                  int(predictsNeighbour(guideP(i), guideQ(i), dx, dy)));
    });
    return;
  }
  const Limits limits = limitsOf(test_);
  mark(count, pair.linkBit, links, [=](int i) {
    return bool(int(p.chain[i] == q.chain[i]) & int(cosine(p, q, i) >= limits.normal) &
                int(similarDistance(p.distance[i], q.distance[i], limits.distance)));
  });
}

}  // namespace ninefold
