#include "common/gi/elements/scene_elements.h"

#include "common/base/error.h"

namespace ninefold {

SceneElements::SceneElements(const StillScene& still, Metres size, const SceneElements* before)
    : meshes_(still.tracer().scene().meshes), size_(size), answers_(still.tracer().answers()) {
  const size_t count = still.tracer().scene().instances.size();
  if (before != nullptr && (before->instances() != count || before->size_ != size))
    before = nullptr;
  const auto changed = before == nullptr ? std::nullopt : rayChanges(*before->answers_, *answers_);
  if (!changed) before = nullptr;
  makeBlocks(still, before);
  for (uint32_t i = 0; i < count; ++i)
    instances_[i].parts = partsOf(still, i, before, changed.value_or(std::vector<Bounds>()));
}

std::shared_ptr<const NodeParts> SceneElements::partsOf(const StillScene& still, uint32_t instance,
                                                        const SceneElements* before,
                                                        const std::vector<Bounds>& changed) const {
  const Tracer& tracer = still.tracer();
  const bool isKept = before != nullptr && isSameBlock(*before, instance) &&
                      before->stands(instance) == stands(instance) &&
                      (!stands(instance) || isInPlace(*before, instance));
  const auto was = isKept ? before->instances_[instance].parts : nullptr;
  if (!stands(instance))
    return isKept ? was : std::make_shared<const NodeParts>(tracer, instance, block(instance));
  Bounds around = boxOf(*answers_, instance);
  around.low -= NodeParts::reach(size_), around.high += NodeParts::reach(size_);
  const auto isNear = [&](const Bounds& box) { return meets(around, box); };
  if (isKept && std::ranges::none_of(changed, isNear)) return was;
  return std::make_shared<const NodeParts>(tracer, instance, block(instance), was.get(), changed);
}

bool SceneElements::isInPlace(const SceneElements& before, uint32_t instance) const {
  return answers_->geometries[instance] == before.answers_->geometries[instance];
}

void SceneElements::makeBlocks(const StillScene& still, const SceneElements* before) {
  const Scene& scene = still.tracer().scene();
  size_t nodes = 0, points = 0;
  for (uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const Mesh& mesh = std::as_const(meshes_)[static_cast<size_t>(instance.mesh)];
    const DMat3 linear = still.linearOf(i);
    const bool isKept = before != nullptr && before->block(i).isOf(mesh, linear, size_);
    instances_.push_back({isKept ? before->instances_[i].block
                                 : std::make_shared<const ElementBlock>(scene, mesh, linear, size_),
                          nullptr});
    nodes += instances_[i].block->nodes(), points += instances_[i].block->points();
    if (nodes > ElementBlock::kMostNodes || points > ElementBlock::kMostPoints)
      fail(
          "the scene has more than {} corners of mesh elements: raise --element-size, or use "
          "another method",
          ElementBlock::kMostNodes);
  }
}

bool SceneElements::isOf(const StillScene& still, Metres size) const {
  const Scene& scene = still.tracer().scene();
  if (scene.instances.size() != instances() || size_ != size) return false;
  for (uint32_t i = 0; i < instances(); ++i) {
    const Mesh& mesh = scene.meshes[static_cast<size_t>(scene.instances[i].mesh)];
    if (!instances_[i].block->isOf(mesh, still.linearOf(i), size)) return false;
  }
  const auto changed = rayChanges(*answers_, *still.tracer().answers());
  return changed && changed->empty();
}

std::shared_ptr<const SceneElements> sceneElements(
    const StillScene& still, Metres size, const std::shared_ptr<const SceneElements>& before) {
  if (before != nullptr && before->isOf(still, size)) return before;
  return std::make_shared<const SceneElements>(still, size, before.get());
}

}  // namespace ninefold
