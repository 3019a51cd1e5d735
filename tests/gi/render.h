// render.h: renders a scene in this thread, without a cluster: mean image and its standard error.
#pragma once

#include <cmath>

#include "common/gi/whole_state.h"
#include "common/scene/methods.h"

namespace ninefold::testing {

struct Rendered {
  int width = 0, height = 0;
  std::vector<Vec3> pixels;   // mean over frames, row-major
  std::vector<double> means;  // mean of each frame's image, average of the channels
  RayCounts rays;

  Vec3 mean() const {
    glm::dvec3 sum(0);
    for (const Vec3& p : pixels) sum += glm::dvec3(p);
    return Vec3(sum / static_cast<double>(pixels.size()));
  }
  double grey() const {
    double sum = 0;
    for (const double m : means) sum += m;
    return sum / static_cast<double>(means.size());
  }
  // Standard error of grey(), from the spread over frames.
  double error() const {
    double sum = 0;
    for (const double m : means) sum += (m - grey()) * (m - grey());
    const double n = static_cast<double>(means.size());
    return std::sqrt(sum / (n * (n - 1)));
  }
};

inline Vec3 pixelAt(const RgbPlane& plane, size_t i) {
  return Vec3(plane.r[i], plane.g[i], plane.b[i]);
}

// Unfiltered: layers composed as reflectance * E + U. `begun`: what a gesture began with, or null.
// `lightCameras`: of all keys.
inline Rendered render(const Tracer& tracer, Settings settings, int frames,
                       const Tracer* begun = nullptr,
                       const std::vector<Camera>& lightCameras = {}) {
  settings.camera = tracer.scene().cameras.front();
  settings.environment = tracer.scene().environment;
  const auto then = begun != nullptr ? std::make_unique<Renderer>(*begun, settings) : nullptr;
  const Renderer renderer(tracer, settings, then.get());
  const auto scratch = renderer.makeScratch();
  const TileGrid grid(settings.width, settings.height, settings.interleave);
  Rendered out{settings.width, settings.height, {}, {}, {}};
  out.pixels.assign(static_cast<size_t>(settings.width * settings.height), Vec3(0));
  TileResult tile;
  const StateFacts* steps = factsOf(settings.method).state;
  std::shared_ptr<const MethodState> state;
  for (uint32_t frame = 0; frame < static_cast<uint32_t>(frames); ++frame) {
    const FrameKey key{frame, frame, frame, settings.photonRadius * tracer.scene().bounds.radius(),
                       lightCameras};
    if (state == nullptr || !steps->servesAll())
      state = wholeState(renderer, settings, frame, &out.rays);
    double sum = 0;
    for (int phase = 0; phase < settings.interleave.sets(); ++phase) {
      const auto lights = renderer.light(
          key, lightSetOfPhase(phase, frame, settings.interleave.sets()), state.get());
      for (int t = 0; t < grid.tiles(); ++t) {
        renderer.render(Task{key, t, phase, 0}, *lights, *scratch, tile);
        out.rays += tile.rays;
        const TaskRect rect = grid.rect(t, phase);
        for (int p = 0; p < tile.count(); ++p) {
          const auto i = static_cast<size_t>(p);
          Vec3 l(0);
          for (int layer = 0; layer < kLayers; ++layer) {
            if (!hasLayer(tile.layerMask, layer)) continue;
            const LayerPlanes& planes = tile.layers[static_cast<size_t>(layer)];
            l += pixelAt(planes.reflectance, i) * pixelAt(planes.irradiance, i) +
                 pixelAt(planes.unfiltered, i);
          }
          const int x = grid.pixelX(phase, rect.i0 + p % rect.width);
          const int y = grid.pixelY(phase, rect.j0 + p / rect.width);
          out.pixels[static_cast<size_t>(y * settings.width + x)] += l / static_cast<float>(frames);
          sum += (static_cast<double>(l.x) + l.y + l.z) / 3;
        }
      }
    }
    out.means.push_back(sum / static_cast<double>(out.pixels.size()));
  }
  return out;
}

inline Settings small(Method method, int side = 12) {
  Settings s;
  s.method = method, s.width = side, s.height = side;
  s.photonPool = 4608;  // enough for so few pixels
  s.fieldPhotons = 4096, s.fieldDirections = 9, s.fieldDistances = 16;
  return s;
}

}  // namespace ninefold::testing
