#include "common/gi/elements/scene_elements.h"

#include "common/base/error.h"
#include "common/scene/world.h"

namespace ninefold {
namespace {

Bounds boxOf(const Mesh& mesh, const DMat4& toWorld) {
  Bounds box;
  for (const Vec3& p : mesh.positions) box.add(worldPoint(toWorld, p));
  return box;
}

}  // namespace

SceneElements::SceneElements(const Tracer& tracer, Metres size, const SceneElements* before)
    : meshes_(tracer.scene().meshes), size_(size) {
  const Scene& scene = tracer.scene();
  if (before != nullptr && (before->instances() != scene.instances.size() || before->size_ != size))
    before = nullptr;
  makeBlocks(scene, before);
  const std::vector<Bounds> changed =
      before == nullptr ? std::vector<Bounds>{} : boxesOfChanges(*before);
  for (uint32_t i = 0; i < instances_.size(); ++i) {
    InstanceElements& its = instances_[i];
    const bool isThere = before != nullptr && its.toWorld == before->instances_[i].toWorld &&
                         its.block == before->instances_[i].block;
    Bounds around = its.box;
    around.low -= NodeParts::reach(size), around.high += NodeParts::reach(size);
    const bool isSame =
        isThere && std::ranges::none_of(changed, [&](const Bounds& b) { return meets(around, b); });
    its.parts = isSame ? before->instances_[i].parts
                       : std::make_shared<const NodeParts>(
                             tracer, i, *its.block,
                             isThere ? before->instances_[i].parts.get() : nullptr, changed);
  }
}

void SceneElements::makeBlocks(const Scene& scene, const SceneElements* before) {
  size_t nodes = 0, points = 0;
  for (size_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const Mesh& mesh = std::as_const(meshes_)[static_cast<size_t>(instance.mesh)];
    const DMat3 linear(instance.toWorld);
    const bool isKept = before != nullptr && before->block(i).isOf(mesh, linear, size_);
    instances_.push_back({instance.toWorld, boxOf(mesh, instance.toWorld),
                          isKept ? before->instances_[i].block
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

// Where something was that moved or was bent, and where it is.
std::vector<Bounds> SceneElements::boxesOfChanges(const SceneElements& before) const {
  std::vector<Bounds> boxes;
  for (size_t i = 0; i < instances_.size(); ++i)
    if (instances_[i].toWorld != before.instances_[i].toWorld ||
        instances_[i].block != before.instances_[i].block)
      boxes.push_back(before.instances_[i].box), boxes.push_back(instances_[i].box);
  return boxes;
}

bool SceneElements::isOf(const Tracer& tracer, Metres size) const {
  const Scene& scene = tracer.scene();
  if (scene.instances.size() != instances() || size_ != size) return false;
  for (size_t i = 0; i < instances(); ++i) {
    const Instance& instance = scene.instances[i];
    const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
    if (instances_[i].toWorld != instance.toWorld ||
        !instances_[i].block->isOf(mesh, DMat3(instance.toWorld), size))
      return false;
  }
  return true;
}

std::shared_ptr<const SceneElements> sceneElements(
    const Tracer& tracer, Metres size, const std::shared_ptr<const SceneElements>& before) {
  if (before != nullptr && before->isOf(tracer, size)) return before;
  return std::make_shared<const SceneElements>(tracer, size, before.get());
}

}  // namespace ninefold
