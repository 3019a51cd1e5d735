// map_stages.h: what the stages of a frame of the photon map cost, in one thread.
//
//   shoot     the paths of one unit, shooting.h, in what photons meet, photon_world.h
//   balance   the k-d tree of all hits, photon_tree.h
//   build     the grid of all hits, photon_cells.h
//   update    the grid as it was: the hits of the oldest unit out, those of the new one in
//   estimate  E of all receivers of the picture from the pool, map_gather.h or vertex_gather.h. Eye
//             paths are traced outside of the time.
//   vertices  with light at vertices: what that costs in other ways, map_vertex_stages.h
//   rest      light() and render() of the whole picture with an empty pool: eye paths, direct light
//             where that is not the pool's, caustic photons
//
// Medians of some repeats, processor time of the thread. In each repeat the pool goes on by a unit;
// `estimate` and `rest`, which take far longer than the others, are of each fifth, `vertices` of
// the first.
//
// Threads: one thread's.   Errors: none.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "common/gi/photon_map/map_gather.h"
#include "common/gi/photon_map/photon_world.h"
#include "common/gi/photon_map/shooting.h"
#include "common/gi/renderer.h"
#include "tools/map_picture.h"
#include "tools/map_vertex_stages.h"
#include "tools/thread_time.h"

namespace ninefold {

struct MapStages {
  double shoot = 0, balance = 0, build = 0, update = 0, estimate = 0, rest = 0;  // [ms]
  size_t hits = 0;                    // of the whole pool, in the last repeat
  double perUnit = 0;                 // mean number of hits of a unit
  std::vector<VertexStage> vertices;  // none with the estimate at pixels
};

class StageTimer {
 public:
  StageTimer(const Tracer& tracer, const Settings& settings)
      : settings_(settings),
        transport_(tracer, settings),
        world_(transport_, nullptr),
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
      if (isSeen) look(one, all);
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

  std::vector<MapPhoton> shot(uint32_t unit) {
    return shootUnit(world_.transport(), 0, unit, layout_, rays_);
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
    one.shoot = threadTime([&] { photons = shot(unit_); });
    one.perUnit = static_cast<double>(photons.size());
    Part& part = parts_[layout_.partOf(unit_)];
    const std::vector<NamedPoint> old = part.points;
    put(std::move(photons));
    one.update = threadTime([&] {
      for (const NamedPoint& p : old) cells_.erase(p);
      for (const NamedPoint& p : part.points) cells_.insert(p);
    });
    std::vector<NamedPoint> all = points();
    one.hits = all.size();
    one.build = threadTime([&] { const PhotonCells cells{all}; });
    one.balance = threadTime([&] { const PhotonTree tree{std::move(all)}; });
    return one;
  }

  // The picture.
  void look(MapStages& one, MapStages& all) {
    std::vector<MapPhoton> pool;
    for (const Part& part : parts_)
      pool.insert(pool.end(), part.photons.begin(), part.photons.end());
    const PhotonPool photons(std::move(pool), settings_.mapIndex);
    if (settings_.mapEstimate == MapEstimate::vertices) {
      VertexStages stages(transport_, photons);
      const VertexStage asked = stages.asked();
      if (all.vertices.empty()) all.vertices = stages.measure(), all.vertices.push_back(asked);
      one.estimate = asked.ms;
    } else {
      one.estimate = estimateTime(photons);
    }
    const FrameKey key = pictureKey(settings_, transport_.scene);
    RgbImage picture;
    one.rest = threadTime([&] { renderPicture(renderer_, settings_, key, nullptr, picture); });
  }

  double estimateTime(const PhotonPool& pool) {
    double time = 0;
    forAllReceivers(transport_, [&](Receivers& receivers) {
      time += threadTime([&] { gatherPool(transport_, pool, 1, 0, scratch_, receivers, rays_); });
    });
    return time;
  }

  struct Part {
    std::vector<MapPhoton> photons;
    std::vector<NamedPoint> points;
  };

  Settings settings_;
  Transport transport_;
  PhotonWorld world_;
  Renderer renderer_;
  MapLayout layout_;
  std::vector<Part> parts_;
  PhotonCells cells_;
  uint32_t unit_ = 0, nextName_ = 0;
  RayCounts rays_;
  MapGatherScratch scratch_;
};

}  // namespace ninefold
