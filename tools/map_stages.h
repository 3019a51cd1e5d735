// map_stages.h: what the stages of a frame of the photon map cost, in one thread.
//
//   shoot     the paths of one unit, shooting.h
//   balance   the k-d tree of all hits, photon_tree.h
//   build     the grid of all hits, photon_cells.h
//   update    the grid as it was: the hits of the oldest unit out, those of the new one in
//   estimate  E of all receivers of the picture from the pool, map_gather.h. Eye paths are traced
//             outside of the time.
//   rest      light() and render() of the whole picture with an empty pool: eye paths, direct light
//             where that is not the pool's, caustic photons
//
// Medians of some repeats, processor time of the thread. In each repeat the pool goes on by a unit;
// `estimate` and `rest`, which take far longer than the others, are of each fifth.
//
// Threads: one thread's.   Errors: none.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "common/base/cpu_time.h"
#include "common/gi/eye/layer_receivers.h"
#include "common/gi/photon_map/map_gather.h"
#include "common/gi/photon_map/shooting.h"
#include "common/gi/renderer.h"
#include "tools/map_picture.h"

namespace ninefold {

struct MapStages {
  double shoot = 0, balance = 0, build = 0, update = 0, estimate = 0, rest = 0;  // [ms]
  size_t hits = 0;     // of the whole pool, in the last repeat
  double perUnit = 0;  // mean number of hits of a unit
};

class StageTimer {
 public:
  StageTimer(const Tracer& tracer, const Settings& settings)
      : settings_(settings),
        transport_(tracer, settings),
        renderer_(tracer, settings),
        layout_(settings),
        parts_(layout_.parts()) {
    for (; unit_ < layout_.parts(); ++unit_) put(shot(unit_));
    cells_ = PhotonCells(points());
  }

  MapStages measure(int repeats) {
    std::array<std::vector<double>, 6> times;
    MapStages all;
    for (int i = 0; i < repeats; ++i, ++unit_) {
      MapStages one = renew();
      const bool isSeen = i % 5 == 0;
      if (isSeen) look(one);
      const std::array values{one.shoot,  one.balance,  one.build,
                              one.update, one.estimate, one.rest};
      for (size_t stage = 0; stage < (isSeen ? 6 : 4); ++stage)
        times[stage].push_back(values[stage]);
      all.hits = one.hits, all.perUnit += one.perUnit / repeats;
    }
    const std::array to{&all.shoot,  &all.balance,  &all.build,
                        &all.update, &all.estimate, &all.rest};
    for (size_t stage = 0; stage < times.size(); ++stage) *to[stage] = median(times[stage]);
    return all;
  }

 private:
  static double median(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  }
  // Processor time that work() takes [ms].
  template <typename Work>
  static double timeOf(const Work& work) {
    const Duration start = threadCpuTime();
    work();
    return 1e3 * seconds(threadCpuTime() - start);
  }

  std::vector<MapPhoton> shot(uint32_t unit) {
    return shootUnit(transport_, 0, unit, layout_, rays_);
  }
  // The hits of a unit take the place of those before; their names are new.
  void put(std::vector<MapPhoton> photons) {
    Part& part = parts_[layout_.partOf(unit_)];
    part.points.clear();
    for (const MapPhoton& p : photons) part.points.push_back({p.position, nextName_++});
    part.photons = std::move(photons);
  }
  std::vector<NamedPoint> points() const {
    std::vector<NamedPoint> all;
    for (const Part& part : parts_) all.insert(all.end(), part.points.begin(), part.points.end());
    return all;
  }

  // The pool after one more unit.
  MapStages renew() {
    MapStages one;
    std::vector<MapPhoton> photons;
    one.shoot = timeOf([&] { photons = shot(unit_); });
    one.perUnit = static_cast<double>(photons.size());
    Part& part = parts_[layout_.partOf(unit_)];
    const std::vector<NamedPoint> old = part.points;
    put(std::move(photons));
    one.update = timeOf([&] {
      for (const NamedPoint& p : old) cells_.erase(p);
      for (const NamedPoint& p : part.points) cells_.insert(p);
    });
    std::vector<NamedPoint> all = points();
    one.hits = all.size();
    one.build = timeOf([&] { const PhotonCells cells{all}; });
    one.balance = timeOf([&] { const PhotonTree tree{std::move(all)}; });
    return one;
  }

  // The picture.
  void look(MapStages& one) {
    std::vector<MapPhoton> pool;
    for (const Part& part : parts_)
      pool.insert(pool.end(), part.photons.begin(), part.photons.end());
    one.estimate = estimateTime(PhotonPool(std::move(pool), settings_.mapIndex));
    const FrameKey key = pictureKey(settings_, transport_.scene);
    RgbImage picture;
    one.rest = timeOf([&] { renderPicture(renderer_, settings_, key, nullptr, picture); });
  }

  double estimateTime(const PhotonPool& pool) {
    const View view = viewOf(transport_, settings_);
    const TileGrid grid(settings_.width, settings_.height, settings_.interleave);
    double time = 0;
    for (int phase = 0; phase < settings_.interleave.sets(); ++phase)
      for (int tile = 0; tile < grid.tiles(); ++tile) {
        const Task task{pictureKey(settings_, transport_.scene), tile, phase, 0};
        TaskContext context(transport_, view, task, tile_, 1);
        layers_.find(context);
        for (int layer = 0; layer < kLayers; ++layer)
          if (hasLayer(tile_.layerMask, layer))
            time += timeOf(
                [&] { gatherPool(transport_, pool, 1, 0, scratch_, layers_.of(layer), rays_); });
      }
    return time;
  }

  struct Part {
    std::vector<MapPhoton> photons;
    std::vector<NamedPoint> points;
  };

  Settings settings_;
  Transport transport_;
  Renderer renderer_;
  MapLayout layout_;
  std::vector<Part> parts_;
  PhotonCells cells_;
  uint32_t unit_ = 0, nextName_ = 0;
  RayCounts rays_;
  TileResult tile_;
  LayerReceivers layers_;
  MapGatherScratch scratch_;
};

}  // namespace ninefold
