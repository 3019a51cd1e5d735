// part.h: some instances with a ray hierarchy of their own, so that what moves can be built anew
// without the rest. Private to this folder.
//
// Triangles are in world space also here; a part is put into the whole without a transform, so that
// hits have the same bits as in one hierarchy. Geometry ids are the instances' indices.
// Owner: shared by the tracers of successive edits; keeps its geometry and the device alive; refers to
// the scene that was read, for alpha masks. Threads: const after construction.
// Errors: throws Error when memory is missing.
#pragma once

#include <memory>
#include <vector>

#include "common/tracing/alpha_mask.h"
#include "common/tracing/device.h"

namespace ninefold {

using Geometries = std::vector<std::shared_ptr<const InstanceGeometry>>;  // by instance

class Part {
 public:
  Part(std::shared_ptr<const Device> device, const Scene& asRead, const Geometries& all,
       std::vector<uint32_t> instances);

  RTCScene hierarchy() const { return hierarchy_.get(); }
  // Of just these instances, none of which has another geometry now.
  bool isOf(const Geometries& all, const std::vector<uint32_t>& instances) const;

 private:
  void attach(uint32_t instance, const InstanceGeometry& geometry, const AlphaMask& mask);

  const std::shared_ptr<const Device> device_;
  const std::vector<uint32_t> instances_;
  Geometries geometries_;         // of instances_
  std::vector<AlphaMask> masks_;  // of instances_
  Hierarchy hierarchy_;
};

// One hierarchy over parts.
Hierarchy joinParts(RTCDevice device, const std::vector<std::shared_ptr<const Part>>& parts);

}  // namespace ninefold
