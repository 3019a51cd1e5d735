// map_vertex_stages.h: what light at vertices costs (--map-estimate vertices), counted and timed in
// one thread, as more and more of the work is saved:
//
//   all       three vertices of each small triangle, each by itself: nothing is shared or culled
//   front     those of small triangles whose front is turned to the eye: back faces culled
//   corners   each vertex of the mesh once: shared between triangles
//   both      each vertex once, if one of its triangles is turned to the eye
//   asked     each vertex once, if a pixel asks for it: what the program does. Its time has the
//             interpolation for all pixels in it; eye paths are traced outside of it
//
// Source:  Jozwowski 2002, 4.4 and Figures 25 to 27.
// Threads: one thread's.   Errors: none.
#pragma once

#include <algorithm>
#include <vector>

#include "common/gi/photon_map/vertex_gather.h"
#include "tools/map_picture.h"
#include "tools/thread_time.h"

namespace ninefold {

struct VertexStage {
  const char* name;
  size_t count = 0;  // of estimates
  double ms = 0;
};

class VertexStages {
 public:
  VertexStages(const Transport& transport, const PhotonPool& pool)
      : t_(transport), pool_(pool), vertices_(transport) {}

  // All but `asked`.
  std::vector<VertexStage> measure() {
    const std::vector<uint32_t> all = cornersOf(false), front = cornersOf(true);
    return {timed("all", all), timed("front", front), timed("corners", once(all)),
            timed("both", once(front))};
  }
  VertexStage asked() {
    VertexLight light(vertices_.entries());
    double ms = 0;
    forAllReceivers(t_, [&](Receivers& receivers) {
      ms += threadTime([&] {
        gatherAtVertices(t_, pool_, vertices_, light, 0, gather_, scratch_, receivers, rays_);
      });
    });
    return {"asked", light.count(), ms};
  }

 private:
  static std::vector<uint32_t> once(std::vector<uint32_t> entries) {
    std::sort(entries.begin(), entries.end());
    entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
    return entries;
  }

  // Three entries for each small triangle.
  std::vector<uint32_t> cornersOf(bool onlyFront) const {
    std::vector<uint32_t> entries;
    const Vec3 eye = t_.settings.camera.eye;
    for (uint32_t object = 0; object < t_.scene.instances.size(); ++object) {
      const auto mesh = static_cast<size_t>(t_.scene.instances[object].mesh);
      for (uint32_t i = 0; i < t_.scene.meshes[mesh].triangles.size(); ++i) {
        const Vec3 from = t_.tracer.corners(object, i).a;
        if (!onlyFront || glm::dot(eye - from, t_.tracer.frontNormal(object, i)) > 0)
          addSmall(object, i, entries);
      }
    }
    return entries;
  }

  // The vertices around the middle of each small triangle.
  void addSmall(uint32_t object, uint32_t triangle, std::vector<uint32_t>& entries) const {
    const int n = 1 << t_.settings.mapSubdivision;
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j)
        for (int half = 0; half < (i + j + 2 <= n ? 2 : 1); ++half) {
          const float inside = half == 0 ? 1 / 3.0f : 2 / 3.0f;
          const auto at = [&](int k) {
            return (static_cast<float>(k) + inside) / static_cast<float>(n);
          };
          const auto around = vertices_.around(object, triangle, at(i), at(j), false);
          entries.insert(entries.end(), around.entry.begin(), around.entry.end());
        }
  }

  VertexStage timed(const char* name, const std::vector<uint32_t>& entries) {
    Receivers points;
    for (const uint32_t entry : entries) points.add(vertices_.receiver(entry));
    return {name, entries.size(),
            threadTime([&] { gatherPoolAlone(t_, pool_, 1, 0, gather_, points, rays_); })};
  }

  const Transport& t_;
  const PhotonPool& pool_;
  MapVertices vertices_;
  MapGatherScratch gather_;
  VertexGatherScratch scratch_;
  RayCounts rays_;
};

}  // namespace ninefold
