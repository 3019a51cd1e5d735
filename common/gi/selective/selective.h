// selective.h: selective photon tracing. The state is what a pool of photons left in mesh elements.
// After an edit those groups of photons are traced anew first whose paths the edit concerns.
//
//   last turn before x          who brings it
//   none: straight from a lamp  direct VPLs, and compensation of their bound: L_e alone; from minor
//                               lamps (minor_lamps.h) the pool
//   D, or a glossy lobe         the pool, by mesh elements (element_light.h)
//   any other S lobe            caustic photons (caustic_photons.h)
//
//   unit of a step   one row of photons (photon_groups.h), the one at its place in the order
//                    (group_order.h). Its photons are traced in the present scene and replace
//                    those of before (group_pages.h).
//   change           A pilot that now hits something else than before tells that the group that it
//                    is like has changed, too: its weight is added to that group's priority P. Any
//                    edit shows in this way: of objects, materials and lamps.
//
// Beyond the paper:
//   - A client keeps the paths that it traced, and traces those again alone that start otherwise
//     than before, or met what has changed (path_replay.h).
//   - A row's hits are kept (12 bytes each), so that old light is taken away without tracing it
//     again with negative energy. A state of which all rows are traced is that of a fresh start, to
//     the last bit.
//   - Pilots, 1/R of the pool, have rows of their own, which take turns with groups. As parts of
//     groups in a chance order they would find little.
//
// At rest each frame has a pool of its own, by numbers with other digit shifts (sampling/halton.h).
// So frames are independent.
//
// Source:  Dmitriev, Brabec, Myszkowski and Seidel 2002.
// Proved:  tests/gi (all tests over the table of methods; selective_test.cpp).
// Fails:   light that has bounced is blurred over an element, on its side of what stands there
//          (node_parts.h), or, in a gesture, of what stands still there (still_scene.h).
// Threads, owner, errors: as method.h says.
#pragma once

#include "common/gi/elements/still_scene.h"
#include "common/gi/elements/surface_numbers.h"
#include "common/gi/light_set/light_set.h"
#include "common/gi/selective/group_order.h"
#include "common/gi/selective/kept_paths.h"
#include "common/gi/selective/photon_groups.h"
#include "common/gi/selective/visual_masking.h"

namespace ninefold {

class Selective final : public LayeredMethod {
 public:
  // `begun`: of the scene that a gesture began with, or null. `before`: of an earlier scene, or
  // null; it saves work alone.
  Selective(const Transport& transport, const Selective* begun, const Selective* before);

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
  const PhotonGroups groups_;
  const std::shared_ptr<const SurfaceNumbers> surfaces_;
  const MinorLamps minor_;
  const uint64_t stamp_;
  const float lampFlux_;  // of all lamps as they are now, largest component [W]
  const std::shared_ptr<const VisualMasking> masking_;  // a gesture keeps that of its beginning
  const StillScene still_;
  const GroupOrder order_;
  const std::shared_ptr<const PathWorld> world_;
  const std::shared_ptr<KeptPaths> kept_;  // null: there are too many
};

}  // namespace ninefold
