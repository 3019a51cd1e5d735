#include "common/gi/photon_map/vertex_gather.h"

namespace ninefold {
namespace {

constexpr int kFromEye = 1;  // D vertices from the eye to a receiver, which is counted

// The vertices around all receivers, and which of them have no light yet.
void findVertices(const Transport& t, const MapVertices& vertices, const VertexLight& light,
                  const Receivers& receivers, VertexGatherScratch& s) {
  s.around.clear(), s.missing.clear();
  for (size_t i = 0; i < receivers.size(); ++i) {
    const uint32_t object = receivers.object[i], triangle = receivers.triangle[i];
    const bool back = glm::dot(t.tracer.frontNormal(object, triangle), receivers.ng(i)) < 0;
    s.around.push_back(vertices.around(object, triangle, receivers.u[i], receivers.v[i], back));
    for (const uint32_t entry : s.around.back().entry)
      if (!light.find(entry)) s.missing.push_back(entry);
  }
  std::sort(s.missing.begin(), s.missing.end());
  s.missing.erase(std::unique(s.missing.begin(), s.missing.end()), s.missing.end());
}

}  // namespace

void gatherAtVertices(const Transport& t, const PhotonPool& pool, const MapVertices& vertices,
                      VertexLight& light, uint32_t randomization, MapGatherScratch& gather,
                      VertexGatherScratch& s, Receivers& receivers, RayCounts& rays) {
  if (pool.photons().empty()) return;
  findVertices(t, vertices, light, receivers, s);
  s.points.clear();
  for (const uint32_t entry : s.missing) s.points.add(vertices.receiver(entry));
  gatherPoolAlone(t, pool, kFromEye, randomization, gather, s.points, rays);
  for (size_t i = 0; i < s.missing.size(); ++i) light.put(s.missing[i], s.points.irradiance(i));
  for (size_t i = 0; i < receivers.size(); ++i) {
    Irradiance e(0);
    for (size_t k = 0; k < 3; ++k) e += s.around[i].weight[k] * *light.find(s.around[i].entry[k]);
    receivers.addIrradiance(i, e);
  }
}

}  // namespace ninefold
