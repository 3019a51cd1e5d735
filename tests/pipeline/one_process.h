// one_process.h: a frame's whole way in one thread: light sets, tasks, tile codec, patches, filter.
// What master and clients do, without the network between them.
#pragma once

#include "common/gi/renderer.h"
#include "common/scene/methods.h"
#include "common/scene/needs.h"
#include "master/assembly/picture.h"
#include "master/running/frame_plan.h"

namespace ninefold::testing {

class OneProcess {
 public:
  // The scene's environment, and its first camera if no other is asked for. `begun`: what a gesture
  // began with, or null.
  OneProcess(const Tracer& tracer, const Settings& settings, const Tracer* begun = nullptr,
             const std::optional<Camera>& camera = {})
      : settings_(completed(settings, tracer.scene(), camera)),
        begun_(begun != nullptr ? std::make_unique<Renderer>(*begun, settings_) : nullptr),
        renderer_(tracer, settings_, begun_.get()),
        scratch_(renderer_.makeScratch()),
        plan_(settings.photonRadius * tracer.scene().bounds.radius(), settings.interleave.sets(),
              true) {
    frame_.view.shape = {
        TileGrid(settings.width, settings.height, settings.interleave),
        layerMaskOf(needsOf(tracer.scene(), settings_.environment), settings.method), 0};
    frame_.view.camera = settings_.camera;
    beauty_.reset(settings.width, settings.height);
  }

  // Those that the light of the next frames is made for; none: the picture's own.
  void setLightCameras(const std::vector<Camera>& cameras) { lightCameras_ = cameras; }

  // As clients filter it: neighbours fade from frame to frame.
  const RgbImage& nextFrame() {
    trace();
    for (int tile = 0; tile < frame_.view.shape.grid.tiles(); ++tile) finish(tile);
    return beauty_;
  }
  // As a film has it that keeps neighbours: unfiltered and filtered.
  std::pair<RgbImage, RgbImage> nextBoth() {
    GatheredFrame& frame = trace();
    frame.view.neighbourWeight = 1;
    std::pair<RgbImage, RgbImage> both;
    both.first.reset(settings_.width, settings_.height);
    for (int tile = 0; tile < frame.view.shape.grid.tiles(); ++tile) {
      finish(tile, &unfiltered_);
      put(unfiltered_, both.first);
    }
    both.second = beauty_;
    return both;
  }
  // The next frame as it is before the filter.
  GatheredFrame& trace() {
    FrameView& view = frame_.view;
    view.key = plan_.next(), view.key.lightCameras = lightCameras_;
    view.neighbourWeight = plan_.neighbourWeight(view.key.frame);
    const int tiles = view.shape.grid.tiles(), sets = settings_.interleave.sets();
    frame_.tasks.clear(), frame_.tasks.resize(static_cast<size_t>(tiles * sets));
    for (int phase = 0; phase < sets; ++phase) {
      const auto lights =
          renderer_.light(view.key, lightSetOfPhase(phase, view.key.rotation, sets));
      for (int tile = 0; tile < tiles; ++tile)
        if (view.shape.grid.rect(tile, phase).count() > 0)  // else it is nobody's task
          frame_.tasks[static_cast<size_t>(tile * sets + phase)] = result(tile, phase, *lights);
    }
    return frame_;
  }

 private:
  static Settings completed(Settings s, const Scene& scene, const std::optional<Camera>& camera) {
    s.camera = camera.value_or(scene.cameras.front()), s.environment = scene.environment;
    return s;
  }
  UnpackedTile result(int tile, int phase, const FrameLight& lights) {
    const FrameShape& shape = frame_.view.shape;
    const TaskRect rect = shape.grid.rect(tile, phase);
    renderer_.render(Task{frame_.view.key, tile, phase, 0}, lights, *scratch_, sent_);
    const uint64_t dither = ditherKey(settings_.seed, frame_.view.key, static_cast<uint32_t>(tile),
                                      static_cast<uint32_t>(phase));
    return decoder_.unpack(encoder_.encode(sent_, dither, 1).bytes,
                           {rect.width, rect.height, shape.layerMask, 0});
  }
  void finish(int tile, RgbImage* unfiltered = nullptr) {
    gather(frame_, tile, patch_);
    filter_.compose(patch_, settings_.camera, frame_.view.neighbourWeight, finished_, unfiltered);
    put(finished_, beauty_);
  }
  // The patch's tile into a picture.
  void put(const RgbImage& tile, RgbImage& picture) const {
    for (int y = 0; y < tile.height; ++y)
      for (int x = 0; x < tile.width; ++x) {
        const Vec3 L = tile.rgb(tile.at(x, y));
        const size_t i = picture.at(patch_.x0() + x, patch_.y0() + y);
        picture.pixels.r[i] = L.x, picture.pixels.g[i] = L.y, picture.pixels.b[i] = L.z;
      }
  }

  Settings settings_;
  std::unique_ptr<const Renderer> begun_;
  Renderer renderer_;
  std::unique_ptr<Scratch> scratch_;
  FramePlan plan_;
  std::vector<Camera> lightCameras_;
  GatheredFrame frame_;
  TileEncoder encoder_;
  TileDecoder decoder_;
  TileResult sent_;
  Patch patch_;
  PatchFilter filter_{SurfaceTest::surface};
  RgbImage finished_, unfiltered_, beauty_;
};

}  // namespace ninefold::testing
