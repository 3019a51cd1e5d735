// task_context.h: what every step of one task needs, gathered once, so that the steps stay short.
//
// Owner: refers to its arguments.   Threads: one thread's value.
#pragma once

#include "common/gi/eye/task.h"
#include "common/image/layers.h"
#include "common/sampling/sampler.h"
#include "common/scene/methods.h"

namespace ninefold {

struct TaskContext {
  TaskContext(const Transport& transport, const View& whose, const Task& which, TileResult& result,
              uint32_t pathsPerPixel)
      : t(transport),
        view(whose),
        task(which),
        grid(view.width, view.height, t.settings.interleave),
        rect(task.rect.value_or(grid.rect(task.tile, task.phase))),
        camera(view.camera, view.width, view.height),
        out(result),
        eyePaths(t.settings.seed, SampleUse::eyePath, task.frame.randomization, pathsPerPixel,
                 t.settings.randomization) {
    out.reset(rect.width, rect.height, layerMaskOf(t.needs, t.settings.method), task.extraMask);
  }

  const Transport& t;
  const View& view;
  const Task& task;
  TileGrid grid;
  TaskRect rect;
  CameraRays camera;
  TileResult& out;
  PixelStream eyePaths;

  bool wants(ExtraPlane plane) const { return (task.extraMask & plane) != 0; }
  PixelSampler sampler(int x, int y, uint32_t path) const {
    return PixelSampler(eyePaths, static_cast<uint32_t>(x), static_cast<uint32_t>(y), path);
  }
  // Place in the image of pixel (i, j) of the task's rectangle.
  int pixelX(int i) const { return grid.pixelX(task.phase, rect.i0 + i); }
  int pixelY(int j) const { return grid.pixelY(task.phase, rect.j0 + j); }
};

inline void put(RgbPlane& plane, size_t i, Vec3 v) {
  plane.r[i] = v.x, plane.g[i] = v.y, plane.b[i] = v.z;
}

}  // namespace ninefold
