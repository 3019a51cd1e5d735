// photon_map.h: photon mapping with a rolling pool. The state is a ring of photon paths. The oldest
// of them are shot anew, frame by frame (shooting.h). The light at x:
//
//   last turn before x          who brings it
//   none: straight from a lamp  direct VPLs, and compensation of their bound: L_e alone;
//                               with --map-direct on the pool, and neither of them
//   D, or a glossy lobe         the pool: the m nearest hits, at each x (map_gather.h) or at the
//                               vertices of a finer mesh (--map-estimate, vertex_gather.h)
//   any other S lobe            caustic photons (caustic_photons.h)
//
// Photons of ...D S+ D start at light-path vertices that are traced for that alone.
//
// Photons may meet a simpler scene in place of what is seen (--photon-scene, photon_world.h). Then
// hits lie off the surfaces that are seen, and count where they are no more than D/8 off
// (map_gather.h); how much surface is around is still asked of the scene that is seen. Light that
// photons would bring to finer things than those of the simpler scene is missing.
//
// The pool lags while lamps and things move: old light is gone after P = total/per-frame frames,
// with the last photon that brought it.
//
// Source:  Jozwowski, "Real Time Photon Mapping", 2002; Jensen 2001.
// Proved:  tests/gi (all tests over the table of methods; photon_map_test.cpp).
// Threads, owner: as method.h says.   Errors: Error for a scene too large for --map-subdivision.
#pragma once

#include "common/gi/light_set/light_set.h"
#include "common/gi/photon_map/map_vertices.h"
#include "common/gi/photon_map/photon_pool.h"
#include "common/gi/photon_map/photon_world.h"

namespace ninefold {

class PhotonMap final : public LayeredMethod {
 public:
  // `begun`: of the state that a gesture began with, or null.
  PhotonMap(const Transport& transport, const PhotonMap* begun);

  // `state` may be null: the empty state, without a photon.
  std::shared_ptr<const FrameLight> light(const FrameKey& frame, int set,
                                          std::span<const View> views,
                                          const MethodState* state) const override;
  std::unique_ptr<Scratch> makeScratch() const override;
  StepResult step(const StatePages& pages, const StepKey& step, uint32_t unit,
                  const View& view) const override;
  std::shared_ptr<const MethodState> digest(const StatePages& pages,
                                            const MethodState* before) const override;

 protected:
  void query(const FrameLight& light, const ReceiverSamples& samples, int pathVertices,
             LayeredScratch& scratch, Receivers& receivers, std::vector<Irradiance>* caustic,
             RayCounts& rays) const override;

 private:
  PhotonWorld world_;
  std::unique_ptr<const MapVertices> vertices_;  // null: light is found at pixels
};

}  // namespace ninefold
