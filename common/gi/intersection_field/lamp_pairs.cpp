#include "common/gi/intersection_field/lamp_pairs.h"

#include <algorithm>
#include <bitset>

#include "common/gi/light/straight_light.h"
#include "common/state/fixed_point.h"

namespace ninefold {
namespace {

using Places = std::bitset<LineGrid::kMostDistances + 1>;  // by m

double meanMeasureOf(const LineGrid& grid) {
  double sum = 0;
  int count = 0;
  for (int family = 0; family < LineGrid::kFamilies; ++family)
    for (int i = 0; i < grid.directions(); ++i)
      for (int k = 0; k < 2 * grid.directions(); ++k, ++count)
        sum += grid.measureOf({family, i, 0, k, 0});
  return sum / count;
}

const Material& materialOf(const Scene& scene, uint32_t instance) {
  const auto mesh = static_cast<size_t>(scene.instances[instance].mesh);
  return scene.materials[static_cast<size_t>(scene.meshes[mesh].material)];
}

bool isEven(const Material& m) { return !m.emissionMap && m.alphaMode == AlphaMode::opaque; }

Hit hitOf(const LineField& field, const GridLine& line, const LineHit& hit) {
  const Vec2 at = field.placeOf(line, hit);
  return {hit.instance, hit.triangle, at.x, at.y, 0};
}

// Marks the lines of a page that meet one of the instances.
void mark(const LineField& field, const std::vector<uint32_t>& instances, const GridLine& page,
          Places& places) {
  for (const uint32_t instance : instances)
    for (const LineRun& run : field.local(instance).page(page.family, page.i, page.j, page.k))
      for (int m = run.first; m < run.first + run.count; ++m) places.set(static_cast<size_t>(m));
}

// Share of light on its `way` that a surface lets pass straight on.
Vec3 passed(const LampScene& scene, const LineHit& hit, const GridLine& line, Vec3 way) {
  const Transport& t = scene.t;
  const auto mesh = static_cast<size_t>(t.scene.instances[hit.instance].mesh);
  if (!t.shader.mayPassStraight(t.scene.meshes[mesh].material)) return Vec3(0);
  const SurfacePoint surface = t.tracer.surface(hitOf(scene.field, line, hit));
  if (!t.shader.passesStraight(surface)) return Vec3(0);
  return straightPass(t.shader.shade(surface, -way, MediumStack()));
}

}  // namespace

LampScene::LampScene(const Transport& transport, const LineField& lines,
                     const SceneElements& places)
    : t(transport), field(lines), elements(places), meanMeasure(meanMeasureOf(lines.grid())) {}

// A line from its place q on the lamp, one way.
struct LampPairs::Line {
  const GridLine& line;
  const std::vector<LineHit>& hits;
  size_t at;  // q among them
  bool isForward;
  Vec3 way;
  float weight;  // g
};

LampPairs::LampPairs(const LampScene& scene, const AreaLamp& lamp, const LampPairs* before,
                     const LampScene* then)
    : sides_(scene.elements.instances()), isKept_(sides_.size(), false) {
  const bool goesOn = before != nullptr && before->isUsable(scene, lamp, *then);
  std::vector<uint32_t> changed;
  for (uint32_t i = 0; goesOn && i < sides_.size(); ++i) {
    isKept_[i] =
        scene.field.isShared(then->field, i) && scene.elements.isSameBlock(then->elements, i);
    if (isKept_[i])
      sides_[i] = before->sides_[i];
    else
      changed.push_back(i);
  }
  if (goesOn && changed.empty()) return;
  const LocalField& local = scene.field.local(lamp.instance);
  GridLine page;
  page.m = -1;  // none yet
  Places wanted;
  std::vector<LineHit> hits;
  local.forEachRun([&](GridLine line, uint32_t r) {
    if (!(line == page)) {
      page = line, wanted.reset();
      if (goesOn)
        mark(scene.field, changed, page, wanted), mark(then->field, changed, page, wanted);
      else
        wanted.set();
    }
    const LineRun& run = local.runs()[r];
    for (line.m = run.first; line.m < run.first + run.count; ++line.m) {
      if (!wanted[static_cast<size_t>(line.m)]) continue;
      ++lines_;
      if (goesOn) look(*then, lamp, line, run, -1, hits);
      look(scene, lamp, line, run, 1, hits);
    }
  });
}

// Whether all that pairs depend on, but what moved, is as it was.
bool LampPairs::isUsable(const LampScene& scene, const AreaLamp& lamp,
                         const LampScene& then) const {
  if (sides_.size() != scene.elements.instances()) return false;
  const Settings &now = scene.t.settings, &was = then.t.settings;
  if (now.fieldWeights != was.fieldWeights || now.elementSize != was.elementSize) return false;
  if (scene.t.radius != then.t.radius) return false;
  if (!scene.t.straightBounds.empty() || !then.t.straightBounds.empty()) return false;
  if (!scene.field.isShared(then.field, lamp.instance)) return false;
  const Material &m = materialOf(scene.t.scene, lamp.instance),
                 &old = materialOf(then.t.scene, lamp.instance);
  return isEven(m) || m.emission == old.emission;
}

const LampPairs::Sums* LampPairs::sumsOf(size_t instance, uint32_t node, bool isBack) const {
  return sides_[instance] == nullptr ? nullptr : &(*sides_[instance])[2 * node + (isBack ? 1 : 0)];
}

size_t LampPairs::bytes() const {
  size_t sum = 0;
  for (const auto& sides : sides_) sum += sides == nullptr ? 0 : sides->size() * sizeof(Sums);
  return sum;
}

void LampPairs::look(const LampScene& scene, const AreaLamp& lamp, const GridLine& line,
                     const LineRun& run, int sign, std::vector<LineHit>& hits) {
  const LineGrid& grid = scene.field.grid();
  scene.field.hitsOf(line, hits);
  const LineHit q{lamp.instance, run.triangle, run.at(line.m)};
  const auto found = std::find(hits.begin(), hits.end(), q);
  const int emitter = scene.t.emitters.find(q.instance, q.triangle);
  if (found == hits.end() || emitter < 0) return;  // a hole, or a dark part of the lamp
  float weight = 1;
  if (scene.t.settings.fieldWeights == FieldWeights::measure) {
    weight = static_cast<float>(grid.measureOf(line) / scene.meanMeasure);
    if (!isEven(materialOf(scene.t.scene, lamp.instance))) {
      const Vec2 at = scene.field.placeOf(line, q);
      const EmitterPoint point = scene.t.emitters.pointAt(static_cast<uint32_t>(emitter), at);
      weight *= maxComponent(point.radiance) / lamp.brightest;
    }
  }
  const Vec3 forward = grid.directionOf(line);
  const float cosine = glm::dot(scene.t.tracer.frontNormal(q.instance, q.triangle), forward);
  for (const bool isForward : {false, true})
    if (lamp.doubleSided || (cosine > 0) == isForward)
      addPairs(scene,
               {line, hits, static_cast<size_t>(found - hits.begin()), isForward,
                isForward ? forward : -forward, weight},
               sign);
}

void LampPairs::addPairs(const LampScene& scene, const Line& from, int sign) {
  const LineGrid& grid = scene.field.grid();
  const float length = grid.lengthOf(from.line);
  const float least = grid.rounding() / length;
  const float close = kClose * scene.t.settings.elementSize * scene.t.radius / length;
  Vec3 seen(1);
  float last = from.hits[from.at].t;  // of the hit before
  for (size_t k = from.at; (from.isForward ? ++k < from.hits.size() : k-- > 0);) {
    const LineHit& hit = from.hits[k];
    if (std::abs(hit.t - from.hits[from.at].t) < least) continue;  // in the lamp's place
    const bool isCovered = isBlack(seen) && std::abs(hit.t - last) < close;
    if (!isCovered) add(scene, from, hit, seen, sign);
    if (!isBlack(seen)) seen *= passed(scene, hit, from.line, from.way);
    last = hit.t;
  }
}

// To the side of a hit that light comes to. What is not kept begins with nothing.
void LampPairs::add(const LampScene& scene, const Line& from, const LineHit& hit, Vec3 seen,
                    int sign) {
  if (sign < 0 && !isKept_[hit.instance]) return;
  const Vec2 at = scene.field.placeOf(from.line, hit);
  const ElementPlace place = scene.elements.block(hit.instance).at(hit.triangle, at.x, at.y);
  const Vec3 normal = scene.t.tracer.frontNormal(hit.instance, hit.triangle);
  const bool isBack = glm::dot(normal, from.way) > 0;
  Sides& sides = own(scene, hit.instance);
  for (size_t c = 0; c < 3; ++c) {
    Sums& sums = sides[2 * place.nodes[c] + (isBack != place.isTurned ? 1 : 0)];
    const double weight = double{from.weight * place.weights[c]};
    const int64_t all = sign * toFixed(weight, kQuantum);
    sums.all += all;
    if (isBlack(seen)) continue;
    for (int i = 0; i < 3; ++i)
      sums.seen[static_cast<size_t>(i)] +=
          seen[i] == 1 ? all : sign * toFixed(weight * double{seen[i]}, kQuantum);
  }
}

LampPairs::Sides& LampPairs::own(const LampScene& scene, uint32_t instance) {
  std::shared_ptr<Sides>& sides = sides_[instance];
  if (sides == nullptr)
    sides = std::make_shared<Sides>(2 * scene.elements.block(instance).nodes());
  else if (sides.use_count() > 1)
    sides = std::make_shared<Sides>(*sides);
  return *sides;
}

}  // namespace ninefold
