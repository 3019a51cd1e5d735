#include "common/gi/intersection_field/lamp_visibility.h"

#include <algorithm>

#include "common/gi/light/straight_light.h"

namespace ninefold {
namespace {

double meanMeasureOf(const LineGrid& grid) {
  double sum = 0;
  int count = 0;
  for (int family = 0; family < LineGrid::kFamilies; ++family)
    for (int i = 0; i < grid.directions(); ++i)
      for (int k = 0; k < 2 * grid.directions(); ++k, ++count)
        sum += grid.measureOf({family, i, 0, k, 0});
  return sum / count;
}

Hit hitOf(const LineField& field, const GridLine& line, const LineHit& hit) {
  const Vec2 at = field.placeOf(line, hit);
  return {hit.instance, hit.triangle, at.x, at.y, 0};
}

// The fraction of 1 that number k adds to u.
float shifted(float u, size_t k) {
  const float sum = u + 0.618034f * static_cast<float>(k);
  return sum - std::floor(sum);
}

}  // namespace

LampVisibility::LampVisibility(const Transport& transport, const LineField& field,
                               const SceneElements& elements)
    : t_(transport),
      field_(field),
      elements_(elements),
      lamps_(areaLamps(transport)),
      meanMeasure_(meanMeasureOf(field.grid())),
      pairs_(lamps_.size(), std::vector<Sides>(elements.instances())) {
  std::vector<LineHit> hits;
  for (size_t lamp = 0; lamp < lamps_.size(); ++lamp) {
    const uint32_t instance = lamps_[lamp].instance;
    const LocalField& local = field.local(instance);
    local.forEachRun([&](GridLine line, uint32_t r) {
      const LineRun& run = local.runs()[r];
      for (line.m = run.first; line.m < run.first + run.count; ++line.m) {
        field.hitsOf(line, hits);
        const LineHit q{instance, run.triangle, run.at(line.m)};
        const auto found = std::find(hits.begin(), hits.end(), q);
        if (found == hits.end()) continue;  // a hole
        const auto place = static_cast<size_t>(found - hits.begin());
        const float cosine =
            glm::dot(t_.tracer.frontNormal(q.instance, q.triangle), field.grid().directionOf(line));
        for (const bool isForward : {false, true})
          if (lamps_[lamp].doubleSided || (cosine > 0) == isForward)
            addPairs(lamp, line, hits, place, isForward);
      }
    });
  }
}

void LampVisibility::addPairs(size_t lamp, const GridLine& line, const std::vector<LineHit>& hits,
                              size_t at, bool isForward) {
  const LineGrid& grid = field_.grid();
  const Hit q = hitOf(field_, line, hits[at]);
  const int emitter = t_.emitters.find(q.instance, q.triangle);
  if (emitter < 0 || !(lamps_[lamp].brightest > 0)) return;
  const EmitterPoint point = t_.emitters.pointAt(static_cast<uint32_t>(emitter), Vec2(q.u, q.v));
  const auto weight = static_cast<float>(grid.measureOf(line) / meanMeasure_) *
                      maxComponent(point.radiance) / lamps_[lamp].brightest;
  const Vec3 way = isForward ? grid.directionOf(line) : -grid.directionOf(line);
  const float least = grid.rounding() / grid.lengthOf(line);
  const float close = kClose * t_.settings.elementSize * t_.radius / grid.lengthOf(line);
  Vec3 seen(1);
  float last = hits[at].t;  // of the hit before
  for (size_t k = at; (isForward ? ++k < hits.size() : k-- > 0);) {
    if (std::abs(hits[k].t - hits[at].t) < least) continue;  // in the lamp's place
    const bool isCovered = isBlack(seen) && std::abs(hits[k].t - last) < close;
    if (!isCovered) add(lamp, hits[k], line, way, seen, weight);
    if (!isBlack(seen)) seen *= passed(hits[k], line, way);
    last = hits[k].t;
  }
}

// To the side of a hit that light on its `way` comes to.
void LampVisibility::add(size_t lamp, const LineHit& hit, const GridLine& line, Vec3 way, Vec3 seen,
                         float weight) {
  const ElementBlock& block = elements_.block(hit.instance);
  const Vec2 at = field_.placeOf(line, hit);
  const ElementPlace place = block.at(hit.triangle, at.x, at.y);
  const bool isBack = glm::dot(t_.tracer.frontNormal(hit.instance, hit.triangle), way) > 0;
  Sides& sides = pairs_[lamp][hit.instance];
  if (sides.empty()) sides.resize(2 * block.nodes());
  for (size_t c = 0; c < 3; ++c) {
    Pairs& pairs = sides[2 * place.nodes[c] + (isBack != place.isTurned ? 1 : 0)];
    pairs.all += weight * place.weights[c];
    pairs.seen += weight * place.weights[c] * seen;
  }
}

Vec3 LampVisibility::passed(const LineHit& hit, const GridLine& line, Vec3 way) const {
  const Scene& scene = t_.scene;
  const auto mesh = static_cast<size_t>(scene.instances[hit.instance].mesh);
  if (!t_.shader.mayPassStraight(scene.meshes[mesh].material)) return Vec3(0);
  const SurfacePoint surface = t_.tracer.surface(hitOf(field_, line, hit));
  if (!t_.shader.passesStraight(surface)) return Vec3(0);
  return straightPass(t_.shader.shade(surface, -way, MediumStack()));
}

LampVisibility::Pairs LampVisibility::at(size_t lamp, const SurfaceNumbers::Surface& surface,
                                         float u, float v) const {
  const Sides& sides = pairs_[lamp][surface.instance];
  Pairs sum;
  if (sides.empty()) return sum;
  const ElementPlace place = elements_.block(surface.instance).at(surface.triangle, u, v);
  for (size_t c = 0; c < 3; ++c) {
    const Pairs& pairs = sides[2 * place.nodes[c] + (surface.isBack != place.isTurned ? 1 : 0)];
    sum.all += place.weights[c] * pairs.all;
    sum.seen += place.weights[c] * pairs.seen;
  }
  return sum;
}

// By one ray to a disk that is chosen in proportion to what it would send.
Irradiance LampVisibility::traced(const std::vector<Irradiance>& shares, const AreaLamp& lamp,
                                  const Receivers& receivers, size_t i, float u,
                                  RayCounts& rays) const {
  float left = 0;
  for (const Irradiance& share : shares) left += maxComponent(share);
  const float all = left;
  left *= u;
  size_t k = 0;
  while (k + 1 < shares.size() && left >= maxComponent(shares[k]))
    left -= maxComponent(shares[k++]);
  if (isBlack(shares[k])) return Irradiance(0);
  const LampDisk& disk = lamp.disks[k];
  const Vec3 origin = receivers.origin(i);
  const bool fromFront = glm::dot(disk.normal, origin - disk.position) > 0;
  const Vec3 way =
      t_.rayTarget(disk.position, fromFront ? disk.normal : -disk.normal, disk.error) - origin;
  const Irradiance whole = all / maxComponent(shares[k]) * shares[k];
  ++rays.shadow;
  if (!t_.tracer.occluded(origin, way, 1)) return whole;
  if (t_.straightBounds.empty()) return Irradiance(0);
  return whole * straightVisibility(t_, origin, way, 1, rays.shadow);
}

void LampVisibility::gather(const ReceiverSamples& samples, int pathVertices, Receivers& receivers,
                            RayCounts& rays) const {
  std::vector<Irradiance> shares(AreaLamp::kDisks);
  for (size_t i = 0; i < receivers.size(); ++i) {
    const uint32_t object = receivers.object[i], triangle = receivers.triangle[i];
    const Vec3 x = receivers.position(i), ng = receivers.ng(i), ns = receivers.ns(i);
    const bool isBack = glm::dot(ng, t_.tracer.frontNormal(object, triangle)) < 0;
    for (size_t k = 0; k < lamps_.size(); ++k) {
      const AreaLamp& lamp = lamps_[k];
      Irradiance h(0);
      for (size_t d = 0; d < lamp.disks.size(); ++d) {
        shares[d] = unshadowed(lamp, lamp.disks[d], x, ng, ns);
        if (receivers.absorber[i] >= 0)
          shares[d] *= t_.shader.transmittance(receivers.absorber[i],
                                               glm::length(lamp.disks[d].position - x));
        h += shares[d];
      }
      if (isBlack(h)) continue;
      const Pairs pairs = at(k, {object, triangle, isBack}, receivers.u[i], receivers.v[i]);
      // No compensation asks for this number: it has no bounded light here.
      const float u = shifted(samples.compensationRoulette(receivers.pixel[i], pathVertices), k);
      receivers.addIrradiance(i, pairs.all >= kFewest
                                     ? h * pairs.seen / pairs.all
                                     : traced(shares, lamp, receivers, i, u, rays));
    }
  }
}

}  // namespace ninefold
