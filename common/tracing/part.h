// part.h: some instances with a ray hierarchy of their own, so that what moves can be built anew
// without the rest. Private to this folder.
//
// Triangles are in world space and geometry ids are the instances' indices, so hits have the same
// bits as in one hierarchy. The parts of a scene are traced one after another (packet.h). Embree's
// own way, a hierarchy of instances, costs a transform a part. Embree 3 also never returns from
// coherent occlusion of sixteen rays through it on AVX-512.
//
// Owner:   shared by the tracers of successive edits. Keeps its geometry and the device alive;
//          refers to the scene that was read, for alpha masks.
// Threads: const after construction.   Errors: throws Error when memory is missing.
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
  // Whether it holds just these instances, each with the geometry that it has in `all`.
  bool isOf(const Geometries& all, const std::vector<uint32_t>& instances) const;

 private:
  void attach(uint32_t instance, const InstanceGeometry& geometry, const AlphaMask& mask);

  const std::shared_ptr<const Device> device_;
  const std::vector<uint32_t> instances_;
  Geometries geometries_;         // of instances_
  std::vector<AlphaMask> masks_;  // of instances_
  Hierarchy hierarchy_;
};

// The instances of each part: first those that never moved, then those that did, by node. A ray
// visits every part, so nodes share parts when there are many. A function of `moved` alone.
std::vector<std::vector<uint32_t>> partition(const Scene& scene, const std::vector<bool>& moved);

}  // namespace ninefold
