// lamp_visibility.h: the light straight from lamps that are surfaces, by the field's lines.
//
//   E(x) = sum over lamps of H V
//   H      without shadows: area_lamps.h
//   V      = sum g vis / sum g, of the three nodes at x, both sums apart: lamp_pairs.h
//
// Nodes whose pairs count less than kFewest know nothing: there a shadow ray to one of the lamp's
// disks takes the place of V.
//
// Source:  Ren et al. 2005, 3 and 5 (VRM).   Proved: tests/gi/lamp_visibility_test.cpp.
// Threads: const after construction.   Owner: refers to its arguments.   Errors: none.
#pragma once

#include "common/base/counters.h"
#include "common/gi/eye/receiver_samples.h"
#include "common/gi/eye/receivers.h"
#include "common/gi/intersection_field/lamp_pairs.h"

namespace ninefold {

class LampVisibility {
 public:
  static constexpr float kFewest = 4;

  // `before`: of the scene before an edit, or null: it saves work alone.
  LampVisibility(const Transport& transport, const LineField& field, const SceneElements& elements,
                 const LampVisibility* before = nullptr);

  // Adds the light straight from area lamps. pathVertices as in layered_method.h.
  void gather(const ReceiverSamples& samples, int pathVertices, Receivers& receivers,
              RayCounts& rays) const;

  const std::vector<AreaLamp>& lamps() const { return lamps_; }
  uint64_t lines() const;  // that were looked at to make it
  size_t bytes() const;

 private:
  // What pairs bring.
  struct Share {
    float all = 0;
    Vec3 seen{0};
  };

  const LampPairs* pairsOf(uint32_t instance) const;
  Irradiance traced(const std::vector<Irradiance>& shares, const AreaLamp& lamp,
                    const Receivers& receivers, size_t i, float u, RayCounts& rays) const;
  Share at(const LampPairs& pairs, const SurfaceNumbers::Surface& surface, float u, float v) const;

  const Transport& t_;
  const LampScene scene_;
  const std::vector<AreaLamp> lamps_;
  std::vector<std::unique_ptr<const LampPairs>> pairs_;  // by lamp
};

}  // namespace ninefold
