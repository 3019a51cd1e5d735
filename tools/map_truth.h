// map_truth.h: a scene at one moment, and its picture as it ought to be.
//
// The truth is the picture of the photon map with a pool of many paths in the scene that is seen,
// E at pixels, direct light by virtual lights, and m = 100 sqrt(paths/2000). So light is blurred
// over (2000/paths)^(1/4) of the radius that 2,000 paths and m = 100 blur it over. It is noise-free
// to 1/sqrt(m) of the bounced light.
//
// Truths may be kept in a folder, for runs of the same scene. A file's name has what they depend
// on, but for the scene, the camera and flags that are no photons'.
//
// Threads: one thread's.   Errors: as Renderer; Error for a folder that cannot be written.
#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <memory>
#include <optional>

#include "common/gi/whole_state.h"
#include "common/image/image_file.h"
#include "tools/map_picture.h"

namespace ninefold {

// A scene with the lamp somewhere, ready to be seen.
class Moment {
 public:
  Moment(const Scene& scene, const std::optional<Vec3>& lamp, const Settings& settings)
      : scene_(scene), settings_(settings) {
    if (lamp) scene_.lights.front().position = *lamp;
    tracer_ = std::make_unique<Tracer>(scene_, Isa::automatic);
    renderer_ = std::make_unique<Renderer>(*tracer_, settings);
  }

  void step(StatePages& pages, uint32_t unit) const {
    StepKey key;
    key.firstUnit = unit;
    pages.apply(renderer_->step(pages, key, unit).deltas);
  }
  StatePages whole() const { return stateAtRest(*renderer_, settings_, 0); }
  RgbImage picture(const StatePages& pages) const {
    RgbImage picture;
    renderPicture(*renderer_, settings_, pictureKey(settings_, scene_),
                  renderer_->digest(pages).get(), picture);
    return picture;
  }

 private:
  Scene scene_;
  Settings settings_;
  std::unique_ptr<Tracer> tracer_;
  std::unique_ptr<Renderer> renderer_;
};

inline Settings truthSettings(Settings s, int paths) {
  constexpr int kMostAtOnce = 65536;
  s.mapPhotons = s.mapPerFrame = paths;
  for (int parts = 1; s.mapPerFrame > kMostAtOnce || paths % s.mapPerFrame != 0; ++parts)
    s.mapPerFrame = paths / parts;
  s.mapNearest = static_cast<int>(std::lround(100 * std::sqrt(paths / 2000.0)));
  s.mapDirect = MapDirect::off, s.mapDistribution = MapDistribution::nets;
  s.mapEstimate = MapEstimate::pixels;
  s.seed += 1'000'003;
  return s;
}

class MapTruth {
 public:
  // folder: where truths are kept; empty: nowhere.
  MapTruth(const Scene& scene, const Settings& settings, int paths, std::string folder)
      : scene_(scene), settings_(truthSettings(settings, paths)), folder_(std::move(folder)) {
    scene_.photonInstances.clear();
  }

  // lamp: where the first one is then; nothing: where the scene has it.
  RgbImage at(int frame, const std::optional<Vec3>& lamp) const {
    const std::string path = folder_.empty() ? "" : nameOf(lamp ? frame : -1);
    if (!path.empty() && access(path.c_str(), R_OK) == 0) return readImage(path);
    const Moment moment(scene_, lamp, settings_);
    RgbImage picture = moment.picture(moment.whole());
    if (!path.empty()) writeImage(path, {picture, {}, {}});
    return picture;
  }

 private:
  std::string nameOf(int frame) const {
    const Settings& s = settings_;
    return fmt::format("{}/truth_{}x{}_{}_paths_length_{}_seed_{}_{}.exr", folder_, s.width,
                       s.height, s.mapPhotons, s.pathLength, s.seed, frame);
  }
  Scene scene_;
  Settings settings_;
  std::string folder_;
};

}  // namespace ninefold
