// map_picture.h: a whole picture in this thread, without film and filter: layers are composed as
// reflectance E + U.
//
// Threads: reentrant.   Errors: as Renderer.
#pragma once

#include "common/gi/eye/layer_receivers.h"
#include "common/gi/renderer.h"
#include "common/image/image.h"
#include "common/scene/settings.h"

namespace ninefold {

// Of a picture whose random numbers stay as they are, as those of pictures in motion do.
inline FrameKey pictureKey(const Settings& settings, const Scene& scene) {
  FrameKey key;
  key.photonRadius = settings.photonRadius * scene.bounds.radius();
  key.state = 1;
  return key;
}

// Calls each(receivers) for all that a picture asks of the light, task by task, layer by layer.
template <typename Each>
void forAllReceivers(const Transport& t, const Each& each) {
  const View view = viewOf(t, t.settings);
  const TileGrid grid(t.settings.width, t.settings.height, t.settings.interleave);
  LayerReceivers layers;
  TileResult result;
  for (int phase = 0; phase < t.settings.interleave.sets(); ++phase)
    for (int tile = 0; tile < grid.tiles(); ++tile) {
      TaskContext context(t, view, Task{pictureKey(t.settings, t.scene), tile, phase, 0}, result,
                          1);
      layers.find(context);
      for (int layer = 0; layer < kLayers; ++layer)
        if (hasLayer(result.layerMask, layer)) each(layers.of(layer));
    }
}

inline Vec3 composed(const TileResult& tile, size_t pixel) {
  Vec3 l(0);
  for (int layer = 0; layer < kLayers; ++layer) {
    if (!hasLayer(tile.layerMask, layer)) continue;
    const LayerPlanes& p = tile.layers[static_cast<size_t>(layer)];
    const auto at = [&](const RgbPlane& c) { return Vec3(c.r[pixel], c.g[pixel], c.b[pixel]); };
    l += at(p.reflectance) * at(p.irradiance) + at(p.unfiltered);
  }
  return l;
}

// settings: those of the renderer.
inline void renderPicture(const Renderer& renderer, const Settings& settings, const FrameKey& key,
                          const MethodState* state, RgbImage& out) {
  out.reset(settings.width, settings.height);
  const TileGrid grid(settings.width, settings.height, settings.interleave);
  const auto scratch = renderer.makeScratch();
  TileResult tile;
  for (int phase = 0; phase < settings.interleave.sets(); ++phase) {
    const auto set = lightSetOfPhase(phase, key.rotation, settings.interleave.sets());
    const auto light = renderer.light(key, set, state);
    for (int t = 0; t < grid.tiles(); ++t) {
      renderer.render(Task{key, t, phase, 0}, *light, *scratch, tile);
      const TaskRect rect = grid.rect(t, phase);
      for (int p = 0; p < tile.count(); ++p) {
        const size_t at = out.at(grid.pixelX(phase, rect.i0 + p % rect.width),
                                 grid.pixelY(phase, rect.j0 + p / rect.width));
        const Vec3 l = composed(tile, static_cast<size_t>(p));
        out.pixels.r[at] = l.x, out.pixels.g[at] = l.y, out.pixels.b[at] = l.z;
      }
    }
  }
}

}  // namespace ninefold
