#include "common/gi/selective/element_light.h"

#include <algorithm>

#include "common/base/error.h"
#include "common/gi/selective/packed_flux.h"
#include "common/state/fixed_point.h"

namespace ninefold {
namespace {

// u of the brightest lamps that any group was traced with.
double quantumOf(const std::vector<std::optional<GroupRow>>& rows) {
  float brightest = 0;
  for (const auto& row : rows)
    if (row) brightest = std::max(brightest, row->lampFlux);
  return fluxQuantum(fluxBand(std::max(brightest, 0x1p-100f)));
}

}  // namespace

SceneElements::SceneElements(const Scene& scene, Metres size, const SceneElements* before)
    : meshes_(scene.meshes) {
  size_t nodes = 0;
  for (size_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const Mesh& mesh = std::as_const(meshes_)[static_cast<size_t>(instance.mesh)];
    const bool isKept = before != nullptr && i < before->instances() &&
                        before->block(i).isOf(mesh, instance.toWorld, size);
    blocks_.push_back(
        isKept ? before->blocks_[i]
               : std::make_shared<const ElementBlock>(scene, mesh, instance.toWorld, size));
    nodes += blocks_.back()->nodes();
    if (nodes > ElementBlock::kMostNodes)
      fail("the scene has more than {} corners of mesh elements: raise --element-size",
           ElementBlock::kMostNodes);
  }
}

ElementLight::ElementLight(const StatePages& pages, const PhotonGroups& groups,
                           std::shared_ptr<const SurfaceNumbers> surfaces,
                           std::shared_ptr<const SceneElements> elements, ElementRule rule,
                           const ElementLight* before)
    : pages_(pages),
      rows_(groups),
      surfaces_(std::move(surfaces)),
      elements_(std::move(elements)),
      rule_(rule) {
  const size_t instances = elements_->instances();
  std::vector<std::optional<GroupRow>> rows(groups.rows());
  for (uint32_t r = 0; r < groups.rows(); ++r) rows[r] = rows_.read(pages_, r);
  quantum_ = quantumOf(rows);

  // Instances whose sums go on from those of `before`, and the rest, which begin with nothing.
  std::vector<bool> kept(instances, false), fresh(instances, true);
  const bool goesOn = before != nullptr && before->quantum_ == quantum_ && before->rule_ == rule_ &&
                      before->elements_->instances() == instances;
  sums_.resize(instances);
  for (size_t i = 0; i < instances; ++i) {
    kept[i] = goesOn && elements_->isShared(*before->elements_, i);
    fresh[i] = !kept[i];
    if (kept[i])
      sums_[i] = before->sums_[i];
    else
      sums_[i].assign(kPerNode * elements_->block(i).nodes(), 0);
  }
  for (uint32_t r = 0; r < groups.rows(); ++r) {
    const bool isSame = goesOn && rows_.isShared(pages_, before->pages_, r);
    if (goesOn && !isSame)
      if (const auto old = rows_.read(before->pages_, r)) add(*old, -1, kept);
    if (!rows[r]) continue;
    add(*rows[r], 1, fresh);
    if (!isSame) add(*rows[r], 1, kept);
  }
}

void ElementLight::add(const GroupRow& row, int64_t sign, const std::vector<bool>& wanted) {
  if (std::find(wanted.begin(), wanted.end(), true) == wanted.end()) return;
  for (const ElementHit& hit : row.hits) {
    if (!surfaces_->isThere(hit.surface)) continue;
    const SurfaceNumbers::Surface surface = surfaces_->surfaceOf(hit.surface);
    if (!wanted[surface.instance]) continue;
    const ElementPlace at =
        place(surface, static_cast<float>(hit.u) / 65535, static_cast<float>(hit.v) / 65535);
    const Flux flux = unpackFlux(hit.flux);
    Sums& sums = sums_[surface.instance];
    for (size_t k = 0; k < 3; ++k) {
      if (at.weights[k] == 0) continue;
      int64_t* of = sums.data() + kPerNode * at.nodes[k] + (surface.isBack != at.isTurned ? 3 : 0);
      const double weight = double{at.weights[k]};
      for (int c = 0; c < 3; ++c) of[c] += sign * toFixed(weight * double{flux[c]}, quantum_);
    }
  }
}

ElementPlace ElementLight::place(const SurfaceNumbers::Surface& surface, float u, float v) const {
  ElementPlace at = elements_->block(surface.instance).at(surface.triangle, u, v);
  if (rule_ == ElementRule::linear) return at;
  const auto nearest = std::max_element(at.weights.begin(), at.weights.end());
  const auto k = static_cast<size_t>(nearest - at.weights.begin());
  return {{at.nodes[k], at.nodes[k], at.nodes[k]}, {1, 0, 0}, at.isTurned};
}

Irradiance ElementLight::at(const SurfaceNumbers::Surface& surface, float u, float v) const {
  const ElementPlace there = place(surface, u, v);
  const ElementBlock& block = elements_->block(surface.instance);
  const Sums& sums = sums_[surface.instance];
  Irradiance e(0);
  for (size_t k = 0; k < 3; ++k) {
    const float area = block.area(there.nodes[k]);
    if (there.weights[k] == 0 || !(area > 0)) continue;
    const int64_t* of =
        sums.data() + kPerNode * there.nodes[k] + (surface.isBack != there.isTurned ? 3 : 0);
    const float scale = there.weights[k] / area;
    for (int c = 0; c < 3; ++c) e[c] += scale * static_cast<float>(fromFixed(of[c], quantum_));
  }
  return e;
}

}  // namespace ninefold
