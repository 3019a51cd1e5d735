// synthetic.h: frames of shapes with known geometry, as a client would return them.
#pragma once

#include <functional>
#include <random>

#include "common/image/image.h"
#include "common/image/patch_filter.h"
#include "common/math/camera.h"

namespace ninefold::synthetic {

struct Point {
  float distance = 0;  // 0 = no x
  Vec3 position{0}, normal{0};
  int part = 0;  // which part of the shape
};

// What the ray from the eye (at the origin) in a direction meets.
using Shape = std::function<Point(Vec3 direction)>;
// E at a pixel that met a point.
using Light = std::function<float(int x, int y, const Point&)>;

inline Camera camera() { return Camera{"", Vec3(0), Vec3(0, 0, -1), Vec3(0, 1, 0), 0.8f}; }

inline Point plane(Vec3 direction, Vec3 through, Vec3 normal) {
  const float d = glm::dot(through, normal) / glm::dot(direction, normal);
  return d > 0 ? Point{d, d * direction, normal} : Point{};
}

inline Point sphere(Vec3 direction, Vec3 centre, float radius) {
  const float b = glm::dot(direction, centre);
  const float inside = b * b - glm::dot(centre, centre) + radius * radius;
  if (inside < 0) return {};
  const float d = b - std::sqrt(inside);
  return {d, d * direction, (d * direction - centre) / radius};
}

inline Point nearer(Point a, Point b) {
  b.part = 1;
  return b.distance == 0 || (a.distance != 0 && a.distance < b.distance) ? a : b;
}

// A whole frame: the sub-plane of each phase.
struct Frame {
  FrameShape shape;
  std::vector<TileResult> phases;

  const TileGrid& grid() const { return shape.grid; }
  const TileResult& phase(int p) const { return phases[static_cast<size_t>(p)]; }
};

// Fills a frame pixel by pixel, phase by phase: f(sub-plane, index, x, y).
template <typename F>
Frame frameOf(const TileGrid& grid, uint8_t layers, uint8_t extras, const F& f) {
  Frame frame{{grid, layers, extras}, {}};
  for (int phase = 0; phase < grid.interleave().sets(); ++phase) {
    TileResult& plane = frame.phases.emplace_back();
    plane.reset(grid.subWidth(phase), grid.subHeight(phase), layers, extras);
    for (int j = 0; j < plane.height; ++j)
      for (int i = 0; i < plane.width; ++i)
        f(plane, static_cast<size_t>(j * plane.width + i), grid.pixelX(phase, i),
          grid.pixelY(phase, j));
  }
  return frame;
}

// A tile with what lies around it.
inline void fill(Patch& patch, const Frame& frame, int tile) {
  patch.reset(frame.shape, tile);
  for (int p = 0; p < patch.phases(); ++p)
    patch.place(p, {0, 0, frame.phase(p).width, frame.phase(p).height}, frame.phase(p));
}

// Calls f(index in the patch's planes, x, y) for the tile's own pixels of a phase.
template <typename F>
void forEachInner(const Patch& patch, int phase, const F& f) {
  const TaskRect& inner = patch.inner(phase);
  for (int j = 0; j < inner.height; ++j)
    for (int i = 0; i < inner.width; ++i)
      f(static_cast<size_t>((j + 1) * Patch::kSide + i + 1),
        patch.grid().pixelX(phase, inner.i0 + i), patch.grid().pixelY(phase, inner.j0 + j));
}

inline void set(RgbPlane& plane, size_t i, Vec3 v) {
  plane.r[i] = v.x, plane.g[i] = v.y, plane.b[i] = v.z;
}
inline Vec3 get(const RgbPlane& plane, size_t i) { return {plane.r[i], plane.g[i], plane.b[i]}; }

// The whole frame, filtered tile by tile.
inline RgbImage composed(const Frame& frame, PatchFilter& filter, const Camera& eye = camera()) {
  RgbImage beauty, tile;
  beauty.reset(frame.grid().width(), frame.grid().height());
  Patch patch;
  for (int t = 0; t < frame.grid().tiles(); ++t) {
    fill(patch, frame, t);
    filter.compose(patch, eye, 1, tile);
    for (int y = 0; y < tile.height; ++y)
      for (int x = 0; x < tile.width; ++x)
        set(beauty.pixels, beauty.at(patch.x0() + x, patch.y0() + y), tile.rgb(tile.at(x, y)));
  }
  return beauty;
}

inline RgbImage composed(const Frame& frame, SurfaceTest test = SurfaceTest::surface) {
  PatchFilter filter(test);
  return composed(frame, filter);
}

// A diffuse frame of a shape under a light. With `jitter` each film position is anywhere in its
// pixel.
inline Frame frameOfShape(const TileGrid& grid, const Shape& shape, const Light& light,
                          bool jitter = false) {
  const CameraRays rays(camera(), grid.width(), grid.height());
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform(0, 1);
  return frameOf(grid, kDiffuseBit, 0, [&](TileResult& out, size_t i, int x, int y) {
    const float px = jitter ? uniform(random) : 0.5f, py = jitter ? uniform(random) : 0.5f;
    const Point point =
        shape(rays.direction(static_cast<float>(x) + px, static_cast<float>(y) + py));
    LayerPlanes& layer = out.layers[kDiffuse];
    layer.distance[i] = point.distance;
    set(layer.normal, i, point.normal);
    set(layer.irradiance, i, Vec3(light(x, y, point)));
    if (point.distance > 0) set(layer.reflectance, i, Vec3(0.25f));
  });
}

// The index of pixel (x, y) in its phase's sub-plane.
inline size_t subIndex(const TileGrid& grid, int x, int y) {
  const int phase = grid.phaseOfPixel(x, y);
  return static_cast<size_t>(y / grid.interleave().m * grid.subWidth(phase) +
                             x / grid.interleave().n);
}

struct Case {
  int width, height;
  Interleave pattern;
};
inline const Case kCases[] = {{1, 1, {1, 1}},     {1, 1, {3, 3}},     {7, 5, {1, 1}},
                              {7, 5, {3, 3}},     {7, 5, {5, 5}},     {7, 5, {2, 2}},
                              {7, 5, {4, 4}},     {3, 2, {4, 4}},     {641, 479, {3, 3}},
                              {200, 131, {5, 5}}, {200, 131, {2, 3}}, {200, 131, {4, 4}}};

}  // namespace ninefold::synthetic
