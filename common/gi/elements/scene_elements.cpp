#include "common/gi/elements/scene_elements.h"

#include "common/base/error.h"
#include "common/scene/world.h"
#include "common/tracing/ray_changes.h"

namespace ninefold {
namespace {

Bounds boxOf(const Mesh& mesh, const DMat4& toWorld) {
  Bounds box;
  for (const Vec3& p : mesh.positions) box.add(worldPoint(toWorld, p));
  return box;
}

}  // namespace

SceneElements::SceneElements(const StillScene& still, Metres size, const SceneElements* before)
    : meshes_(still.tracer().scene().meshes), size_(size) {
  const size_t count = still.tracer().scene().instances.size();
  if (before != nullptr && (before->instances() != count || before->size_ != size))
    before = nullptr;
  makeBlocks(still, before);
  const std::vector<Bounds> changed =
      before == nullptr ? std::vector<Bounds>{} : boxesOfChanges(*before);
  for (uint32_t i = 0; i < count; ++i) instances_[i].parts = partsOf(still, i, before, changed);
}

std::shared_ptr<const NodeParts> SceneElements::partsOf(const StillScene& still, uint32_t instance,
                                                        const SceneElements* before,
                                                        const std::vector<Bounds>& changed) const {
  const InstanceElements& its = instances_[instance];
  const InstanceElements* was = before == nullptr ? nullptr : &before->instances_[instance];
  const bool stands = its.shownBy != nullptr;
  if (was != nullptr && (was->block != its.block || (was->shownBy != nullptr) != stands))
    was = nullptr;
  const Tracer& tracer = still.tracer();
  if (!stands)
    return was != nullptr ? was->parts
                          : std::make_shared<const NodeParts>(tracer, instance, *its.block);
  if (was != nullptr && was->toWorld != its.toWorld) was = nullptr;
  Bounds around = its.box;
  around.low -= NodeParts::reach(size_), around.high += NodeParts::reach(size_);
  const auto isNear = [&](const Bounds& box) { return meets(around, box); };
  if (was != nullptr && std::ranges::none_of(changed, isNear)) return was->parts;
  return std::make_shared<const NodeParts>(tracer, instance, *its.block,
                                           was != nullptr ? was->parts.get() : nullptr, changed);
}

void SceneElements::makeBlocks(const StillScene& still, const SceneElements* before) {
  const Scene& scene = still.tracer().scene();
  size_t nodes = 0, points = 0;
  for (uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const Mesh& mesh = std::as_const(meshes_)[static_cast<size_t>(instance.mesh)];
    const DMat3 linear = still.linearOf(i);
    const bool isKept = before != nullptr && before->block(i).isOf(mesh, linear, size_);
    instances_.push_back({instance.toWorld, boxOf(mesh, instance.toWorld),
                          isKept ? before->instances_[i].block
                                 : std::make_shared<const ElementBlock>(scene, mesh, linear, size_),
                          still.tracer().partOf(i), nullptr});
    nodes += instances_[i].block->nodes(), points += instances_[i].block->points();
    if (nodes > ElementBlock::kMostNodes || points > ElementBlock::kMostPoints)
      fail(
          "the scene has more than {} corners of mesh elements: raise --element-size, or use "
          "another method",
          ElementBlock::kMostNodes);
  }
}

// Where something stood that moved, was bent, or is met by other rays of its own, and where it
// stands.
std::vector<Bounds> SceneElements::boxesOfChanges(const SceneElements& before) const {
  std::vector<Bounds> boxes;
  for (size_t i = 0; i < instances_.size(); ++i) {
    const InstanceElements &is = instances_[i], &was = before.instances_[i];
    if (is.toWorld == was.toWorld && is.block == was.block &&
        answerAlike(is.shownBy.get(), was.shownBy.get()))
      continue;
    if (was.shownBy != nullptr) boxes.push_back(was.box);
    if (is.shownBy != nullptr) boxes.push_back(is.box);
  }
  return boxes;
}

bool SceneElements::isOf(const StillScene& still, Metres size) const {
  const Scene& scene = still.tracer().scene();
  if (scene.instances.size() != instances() || size_ != size) return false;
  for (uint32_t i = 0; i < instances(); ++i) {
    const Instance& instance = scene.instances[i];
    const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
    const InstanceElements& its = instances_[i];
    if (its.toWorld != instance.toWorld || !its.block->isOf(mesh, still.linearOf(i), size) ||
        !answerAlike(its.shownBy.get(), still.tracer().partOf(i).get()))
      return false;
  }
  return true;
}

std::shared_ptr<const SceneElements> sceneElements(
    const StillScene& still, Metres size, const std::shared_ptr<const SceneElements>& before) {
  if (before != nullptr && before->isOf(still, size)) return before;
  return std::make_shared<const SceneElements>(still, size, before.get());
}

}  // namespace ninefold
