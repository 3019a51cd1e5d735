// part.h: some instances with a ray hierarchy of their own, so that what moves can be built anew
// without the rest. Private to this folder.
//
//   all    every instance as it was read; built once, and the same in all edits
//   left   instances that `all` cannot show, as they share a mask bit with one that moved
//   moved  instances that ever moved, by node; nodes share parts when there are many
//
// Rays do not see in `all` what moved: its mask bit is not theirs. So what did not move is traced
// by the same hierarchy before and after an edit, and answers with the same bits, also where two
// triangles are met at the same distance.
//
// Triangles are in world space and geometry ids are the instances' indices. The parts of a scene
// are traced one after another (packet.h). Embree's own way, a hierarchy of instances, costs a
// transform a part. Embree 3 also never returns from coherent occlusion of sixteen rays through it
// on AVX-512.
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

// The mask bit of each instance. Each node has one of its own while there are enough. Else nodes
// that reach through half of the scene share one bit, and all others share the rest.
class MaskBits {
 public:
  MaskBits(const Scene& asRead, const Geometries& geometries);
  uint32_t of(uint32_t instance) const { return bits_[instance]; }

 private:
  std::vector<uint32_t> bits_;
};

class Part {
 public:
  Part(std::shared_ptr<const Device> device, const Scene& asRead, const Geometries& all,
       const MaskBits& bits, std::vector<uint32_t> instances);

  RTCScene hierarchy() const { return hierarchy_.get(); }
  // Whether it holds just these instances, each with the geometry that it has in `all`.
  bool isOf(const Geometries& all, const std::vector<uint32_t>& instances) const;
  // Whether rays have the same answers in both.
  bool isLike(const Part& other) const {
    return instances_ == other.instances_ && geometries_ == other.geometries_;
  }

 private:
  void attach(uint32_t instance, const InstanceGeometry& geometry, const AlphaMask& mask,
              uint32_t bit);

  const std::shared_ptr<const Device> device_;
  const std::vector<uint32_t> instances_;
  Geometries geometries_;         // of instances_
  std::vector<AlphaMask> masks_;  // of instances_
  Hierarchy hierarchy_;
};

// What rays see of a part.
struct SeenPart {
  RTCScene hierarchy;
  uint32_t mask;  // of rays in it
};
using Hierarchies = std::vector<SeenPart>;

// The instances of the parts `left` and `moved`; none is empty. A function of the scene that was
// read, of `moved`, and of what rays shall not see. mask: of rays in `all`.
struct Partition {
  uint32_t mask = ~0u;
  std::vector<std::vector<uint32_t>> sets;
};
Partition partition(const Scene& asRead, const MaskBits& bits, const std::vector<bool>& moved,
                    const std::vector<bool>& hidden);

}  // namespace ninefold
