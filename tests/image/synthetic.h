// synthetic.h: frames of shapes with known geometry, as a client would return them.
#pragma once

#include <functional>
#include <random>

#include "common/image/frame_buffer.h"
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

// Calls f(result, index in it, x, y) for each pixel of a task's result.
template <typename F>
void forEachPixel(const TileGrid& grid, int tile, int phase, TileResult& result, const F& f) {
  const TaskRect rect = grid.rect(tile, phase);
  for (int j = 0; j < rect.height; ++j)
    for (int i = 0; i < rect.width; ++i)
      f(result, static_cast<size_t>(j * rect.width + i), grid.pixelX(phase, rect.i0 + i),
        grid.pixelY(phase, rect.j0 + j));
}

// Fills a frame pixel by pixel, task by task: f(result, index, x, y).
template <typename F>
FrameBuffer frameOf(const TileGrid& grid, uint8_t layers, uint8_t extras, const F& f) {
  FrameBuffer frame(grid, layers, extras);
  TileResult result;
  for (int tile = 0; tile < grid.tiles(); ++tile)
    for (int phase = 0; phase < grid.interleave().sets(); ++phase) {
      const TaskRect rect = grid.rect(tile, phase);
      result.reset(rect.width, rect.height, layers, extras);
      forEachPixel(grid, tile, phase, result, f);
      frame.place(tile, phase, result);
    }
  return frame;
}

inline void set(RgbPlane& plane, size_t i, Vec3 v) {
  plane.r[i] = v.x, plane.g[i] = v.y, plane.b[i] = v.z;
}
inline Vec3 get(const RgbPlane& plane, size_t i) { return {plane.r[i], plane.g[i], plane.b[i]}; }

// A diffuse frame of a shape under a light. With `jitter` each film position is anywhere in its
// pixel.
inline FrameBuffer frameOfShape(const TileGrid& grid, const Shape& shape, const Light& light,
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
