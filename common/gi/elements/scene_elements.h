// scene_elements.h: the mesh elements of all instances, and what stands on them: a function of the
// scene as it is now, of what moves in a gesture (still_scene.h), and of h.
//
// After an edit only those elements are looked at anew where rays may have other answers
// (tracing/ray_changes.h).
//
// Threads: const after construction.   Owner: shares the scene's meshes.
// Errors:  throws Error if there are too many elements.
#pragma once

#include <memory>
#include <vector>

#include "common/gi/elements/node_parts.h"
#include "common/gi/elements/still_scene.h"
#include "common/tracing/ray_changes.h"

namespace ninefold {

class SceneElements {
 public:
  // `before`: of another state of the scene, or null: it saves work alone.
  SceneElements(const StillScene& still, Metres size, const SceneElements* before);

  // Whether it would come out the same.
  bool isOf(const StillScene& still, Metres size) const;
  size_t instances() const { return instances_.size(); }
  const ElementBlock& block(size_t instance) const { return *instances_[instance].block; }
  const NodeParts& parts(size_t instance) const { return *instances_[instance].parts; }
  // The same elements, wherever they are.
  bool isSameBlock(const SceneElements& other, size_t instance) const {
    return instances_[instance].block == other.instances_[instance].block;
  }
  // What lies there, and what stands on it, is the same.
  bool isShared(const SceneElements& other, size_t instance) const {
    return instances_[instance].parts == other.instances_[instance].parts;
  }
  // `tracer`: of a StillScene that is the same around the instance.
  PartPlace at(const Tracer& tracer, const SurfaceNumbers::Surface& surface, float u,
               float v) const {
    return parts(surface.instance).at(tracer, block(surface.instance), surface, u, v);
  }

 private:
  struct InstanceElements {
    std::shared_ptr<const ElementBlock> block;
    std::shared_ptr<const NodeParts> parts;
  };
  void makeBlocks(const StillScene& still, const SceneElements* before);
  std::shared_ptr<const NodeParts> partsOf(const StillScene& still, uint32_t instance,
                                           const SceneElements* before,
                                           const std::vector<Bounds>& changed) const;
  // Where it was, to the last bit.
  bool isInPlace(const SceneElements& before, uint32_t instance) const;
  bool stands(uint32_t instance) const { return answers_->shows[instance] != nullptr; }

  SharedList<Mesh> meshes_;  // so that no other mesh takes the place of one
  Metres size_;
  std::shared_ptr<const RayAnswers> answers_;  // that parts were looked for with
  std::vector<InstanceElements> instances_;
};

// `before` itself, if it is what would be made.
std::shared_ptr<const SceneElements> sceneElements(
    const StillScene& still, Metres size, const std::shared_ptr<const SceneElements>& before);

}  // namespace ninefold
