#include "common/gi/elements/element_light.h"

#include <algorithm>

#include "common/base/error.h"
#include "common/gi/elements/hit_changes.h"
#include "common/gi/elements/packed_flux.h"
#include "common/state/fixed_point.h"

namespace ninefold {
namespace {

// u of the brightest lamps that any row was traced with.
double quantumOf(const StatePages& pages, const PhotonRows& rows) {
  float brightest = 0;
  for (uint32_t r = 0; r < rows.count(); ++r)
    if (const auto header = rows.header(pages, r))
      brightest = std::max(brightest, header->lampFlux);
  return fluxQuantum(fluxBand(std::max(brightest, 0x1p-100f)));
}

// Whether half of the rows or more are the same, or of the same photons: most of those leave the
// same hits. If not, it is quicker to add up all rows than to take away and add what changed.
bool sharesMost(const StatePages& a, const StatePages& b, const PhotonRows& rows) {
  const auto isAlike = [&](uint32_t r) {
    if (rows.isShared(a, b, r)) return true;
    const auto one = rows.header(a, r), other = rows.header(b, r);
    return one && other && one->randomization == other->randomization &&
           one->lampFlux == other->lampFlux;
  };
  uint32_t alike = 0;
  for (uint32_t r = 0; r < rows.count(); ++r) alike += isAlike(r);
  return 2 * alike >= rows.count();
}

bool hasAny(const std::vector<bool>& wanted) {
  return std::find(wanted.begin(), wanted.end(), true) != wanted.end();
}

}  // namespace

ElementLight::ElementLight(const Tracer& tracer, const StatePages& pages, const PhotonRows& rows,
                           std::shared_ptr<const SurfaceNumbers> surfaces,
                           std::shared_ptr<const SceneElements> elements, ElementRule rule,
                           const ElementLight* before)
    : pages_(pages),
      rows_(rows),
      surfaces_(std::move(surfaces)),
      elements_(std::move(elements)),
      rule_(rule),
      quantum_(quantumOf(pages_, rows_)) {
  const bool goesOn = before != nullptr && before->quantum_ == quantum_ && before->rule_ == rule_ &&
                      before->rows_ == rows_ &&
                      before->elements_->instances() == elements_->instances() &&
                      sharesMost(pages_, before->pages_, rows_);
  const Wanted fresh = begin(goesOn ? before : nullptr);
  Wanted kept = fresh;
  kept.flip();
  const bool anyFresh = hasAny(fresh), anyKept = hasAny(kept);
  for (uint32_t r = 0; r < rows_.count(); ++r) {
    const bool isSame = goesOn && rows_.isShared(pages_, before->pages_, r);
    if (isSame && !anyFresh) continue;
    const auto now = rows_.read(pages_, r);
    if (anyFresh && now)
      for (const ElementHit& hit : now->hits) add(tracer, hit, 1, fresh);
    if (isSame || !anyKept) continue;
    const auto old = rows_.read(before->pages_, r);
    change(tracer, old.value_or(PhotonRow()), now.value_or(PhotonRow()), kept);
  }
}

void ElementLight::change(const Tracer& tracer, const PhotonRow& before, const PhotonRow& now,
                          const Wanted& kept) {
  forEachChange(
      before.hits, now.hits, [&](const ElementHit& hit) { add(tracer, hit, -1, kept); },
      [&](const ElementHit& hit) { add(tracer, hit, 1, kept); });
}

ElementLight::Wanted ElementLight::begin(const ElementLight* before) {
  const size_t instances = elements_->instances();
  Wanted fresh(instances, true);
  sums_.resize(instances), isOwn_.assign(instances, true);
  for (size_t i = 0; i < instances; ++i) {
    if (before != nullptr && elements_->isShared(*before->elements_, i))
      sums_[i] = before->sums_[i], isOwn_[i] = fresh[i] = false;
    else
      sums_[i] = std::make_shared<Sums>(kPerPart * elements_->parts(i).size(), 0);
  }
  return fresh;
}

ElementLight::Sums& ElementLight::own(uint32_t instance) {
  if (!isOwn_[instance]) sums_[instance] = std::make_shared<Sums>(*sums_[instance]);
  isOwn_[instance] = true;
  return *sums_[instance];
}

void ElementLight::add(const Tracer& tracer, const ElementHit& hit, int64_t sign,
                       const Wanted& wanted) {
  if (!surfaces_->isThere(hit.surface)) return;
  const SurfaceNumbers::Surface surface = surfaces_->surfaceOf(hit.surface);
  if (!wanted[surface.instance]) return;
  const PartPlace at =
      place(tracer, surface, static_cast<float>(hit.u) / 65535, static_cast<float>(hit.v) / 65535);
  const Flux flux = unpackFlux(hit.flux);
  Sums& sums = own(surface.instance);
  for (size_t k = 0; k < 3; ++k) {
    if (at.weights[k] == 0) continue;
    int64_t* of = sums.data() + kPerPart * at.parts[k];
    const double weight = double{at.weights[k]};
    for (int c = 0; c < 3; ++c) of[c] += sign * toFixed(weight * double{flux[c]}, quantum_);
  }
}

PartPlace ElementLight::place(const Tracer& tracer, const SurfaceNumbers::Surface& surface, float u,
                              float v) const {
  PartPlace at = elements_->at(tracer, surface, u, v);
  if (rule_ == ElementRule::linear) return at;
  const auto nearest = std::max_element(at.weights.begin(), at.weights.end());
  const uint32_t part = at.parts[static_cast<size_t>(nearest - at.weights.begin())];
  return {{part, part, part}, {1, 0, 0}};
}

Irradiance ElementLight::at(const Tracer& tracer, const SurfaceNumbers::Surface& surface, float u,
                            float v) const {
  const PartPlace there = place(tracer, surface, u, v);
  const NodeParts& parts = elements_->parts(surface.instance);
  const Sums& sums = *sums_[surface.instance];
  Irradiance e(0);
  for (size_t k = 0; k < 3; ++k) {
    const float area = parts.area(there.parts[k]);
    if (there.weights[k] == 0 || !(area > 0)) continue;
    const int64_t* of = sums.data() + kPerPart * there.parts[k];
    const float scale = there.weights[k] / area;
    for (int c = 0; c < 3; ++c) e[c] += scale * static_cast<float>(fromFixed(of[c], quantum_));
  }
  return e;
}

void ElementLight::addTo(const Tracer& tracer, Receivers& receivers) const {
  for (size_t i = 0; i < receivers.size(); ++i) {
    const uint32_t object = receivers.object[i], triangle = receivers.triangle[i];
    const bool isBack = glm::dot(receivers.ng(i), tracer.frontNormal(object, triangle)) < 0;
    receivers.addIrradiance(i,
                            at(tracer, {object, triangle, isBack}, receivers.u[i], receivers.v[i]));
  }
}

}  // namespace ninefold
