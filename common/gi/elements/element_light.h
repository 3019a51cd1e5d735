// element_light.h: the light that all rows leave in the mesh elements, ready to be asked.
//
//   Phi_part  = sum over hits of w Phi        whole numbers of the quantum u (state/fixed_point.h)
//   E(x)      = sum over the three parts at x of w Phi_part / A_part     [W/m^2]
//
// with w the barycentrics in the element (element_block.h), and those parts of its three nodes that
// x sees (node_parts.h), both sides of a surface apart. By buckets, as published: a photon and a
// point have the nearest node alone.
//
// Sums of whole numbers do not depend on their order. So what changed is taken away and added, and
// the sums are those of a fresh start to the last bit.
//
// Proved:  tests/gi/element_test.cpp.
// Threads: const after construction.   Owner: shares the scene's meshes.
// Errors:  throws Error for a flux that no lamp of the scene can have.
#pragma once

#include <memory>
#include <vector>

#include "common/gi/elements/photon_rows.h"
#include "common/gi/elements/scene_elements.h"
#include "common/gi/elements/surface_numbers.h"
#include "common/gi/eye/receivers.h"
#include "common/gi/method/method.h"

namespace ninefold {

class ElementLight : public MethodState {
 public:
  // `tracer`: of the StillScene that the elements are of; likewise below.
  // `before`: of other pages, or of another state of the same scene; or null. It saves work alone.
  ElementLight(const Tracer& tracer, const StatePages& pages, const PhotonRows& rows,
               std::shared_ptr<const SurfaceNumbers> surfaces,
               std::shared_ptr<const SceneElements> elements, ElementRule rule,
               const ElementLight* before);

  const std::shared_ptr<const SceneElements>& elements() const { return elements_; }
  Irradiance at(const Tracer& tracer, const SurfaceNumbers::Surface& surface, float u,
                float v) const;
  // Adds E to receivers.
  void addTo(const Tracer& tracer, Receivers& receivers) const;

 private:
  static constexpr size_t kPerPart = 3;  // R, G, B
  using Sums = std::vector<int64_t>;     // of one instance
  using Wanted = std::vector<bool>;      // by instance

  // Takes over from `before` the sums of instances that are the same, and tells the others.
  Wanted begin(const ElementLight* before);
  // Adds a hit, `sign` times, if its instance is wanted.
  void add(const Tracer& tracer, const ElementHit& hit, int64_t sign, const Wanted& wanted);
  // Makes of what a row left what it leaves now, in the instances that are kept.
  void change(const Tracer& tracer, const PhotonRow& before, const PhotonRow& now,
              const Wanted& kept);
  Sums& own(uint32_t instance);

  PartPlace place(const Tracer& tracer, const SurfaceNumbers::Surface& surface, float u,
                  float v) const;

  StatePages pages_;
  const PhotonRows rows_;
  std::shared_ptr<const SurfaceNumbers> surfaces_;
  std::shared_ptr<const SceneElements> elements_;
  ElementRule rule_;
  const double quantum_;                     // u [W]
  std::vector<std::shared_ptr<Sums>> sums_;  // shared with other versions where they are the same
  std::vector<bool> isOwn_;                  // by instance: sums that no other version has
};

}  // namespace ninefold
