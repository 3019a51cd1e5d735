#include "common/gi/intersection_field/lamp_pairs.h"

#include "common/state/fixed_point.h"

namespace ninefold {
namespace {

using Lines = LampLines::Lines;

// Marks the lines of a page that meet one of the instances.
void mark(const LineField& field, const std::vector<uint32_t>& instances, const GridLine& page,
          Lines& lines) {
  for (const uint32_t instance : instances)
    for (const LineRun& run : field.local(instance).page(page.family, page.i, page.j, page.k))
      for (int m = run.first; m < run.first + run.count; ++m) lines.set(static_cast<size_t>(m));
}

uint64_t countOf(const LineRun& run, const Lines& lines) {
  uint64_t count = 0;
  for (int m = run.first; m < run.first + run.count; ++m)
    count += lines[static_cast<size_t>(m)] ? 1 : 0;
  return count;
}

Radiance emissionOf(const LampScene& scene, uint32_t instance) {
  const Scene& its = scene.t.scene;
  const auto mesh = static_cast<size_t>(its.instances[instance].mesh);
  return its.materials[static_cast<size_t>(its.meshes[mesh].material)].emission;
}

}  // namespace

LampPairs::LampPairs(LampLines& now, const AreaLamp& lamp, const LampPairs* before, LampLines* then)
    : sides_(now.scene().elements.instances()), isKept_(sides_.size(), false) {
  const LampScene& scene = now.scene();
  const LocalField& local = scene.field.local(lamp.instance);
  const bool goesOn = before != nullptr && before->isUsable(scene, lamp, then->scene());
  if (!goesOn) {
    local.forEachPage([&](const GridLine& page, uint32_t first, uint32_t end) {
      for (const LampLines::Pair& pair : now.pairsOf(lamp, page, nullptr)) add(scene, pair, 1);
      for (uint32_t r = first; r < end; ++r) lines_ += local.runs()[r].count;
    });
    return;
  }
  const Changed changed = goOn(*before, scene, then->scene());
  if (changed.empty()) return;
  local.forEachPage([&](const GridLine& page, uint32_t first, uint32_t end) {
    Lines lines;
    mark(scene.field, changed, page, lines), mark(then->scene().field, changed, page, lines);
    if (lines.none()) return;
    for (const LampLines::Pair& pair : then->pairsOf(lamp, page, &lines))
      add(then->scene(), pair, -1);
    for (const LampLines::Pair& pair : now.pairsOf(lamp, page, &lines)) add(scene, pair, 1);
    for (uint32_t r = first; r < end; ++r) lines_ += countOf(local.runs()[r], lines);
  });
}

// Takes over what stays; returns the instances whose sums begin anew.
LampPairs::Changed LampPairs::goOn(const LampPairs& before, const LampScene& scene,
                                   const LampScene& then) {
  Changed changed;
  for (uint32_t i = 0; i < sides_.size(); ++i) {
    isKept_[i] =
        scene.field.isShared(then.field, i) && scene.elements.isSameBlock(then.elements, i);
    if (isKept_[i])
      sides_[i] = before.sides_[i];
    else
      changed.push_back(i);
  }
  return changed;
}

// Whether all that pairs depend on, but what moved, is as it was.
bool LampPairs::isUsable(const LampScene& scene, const AreaLamp& lamp,
                         const LampScene& then) const {
  if (sides_.size() != scene.elements.instances()) return false;
  const Settings &now = scene.t.settings, &was = then.t.settings;
  if (now.fieldWeights != was.fieldWeights || now.elementSize != was.elementSize) return false;
  if (!scene.t.straightBounds.empty() || !then.t.straightBounds.empty()) return false;
  if (!scene.field.isShared(then.field, lamp.instance)) return false;
  return lamp.isEven || emissionOf(scene, lamp.instance) == emissionOf(then, lamp.instance);
}

const LampPairs::Sums* LampPairs::sumsOf(size_t instance, uint32_t node, bool isBack) const {
  return sides_[instance] == nullptr ? nullptr : &(*sides_[instance])[2 * node + (isBack ? 1 : 0)];
}

size_t LampPairs::bytes() const {
  size_t sum = 0;
  for (const auto& sides : sides_) sum += sides == nullptr ? 0 : sides->size() * sizeof(Sums);
  return sum;
}

// To the side of p that light comes to. What is not kept begins with nothing.
void LampPairs::add(const LampScene& scene, const LampLines::Pair& pair, int sign) {
  if (sign < 0 && !isKept_[pair.instance]) return;
  const TriangleElements::Place place = pair.elements.at(pair.at.x, pair.at.y);
  const bool isDimmed = !isBlack(pair.seen) && pair.seen != Vec3(1);
  const int64_t seen = isBlack(pair.seen) ? 0 : -1;  // all bits or none
  Sides& sides = own(scene, pair.instance);
  for (size_t c = 0; c < 3; ++c) {
    Sums& sums = sides[2 * place.nodes[c] + (pair.isBack ? 1 : 0)];
    const double weight = double{pair.weight * place.weights[c]};
    const int64_t all = sign * toFixed(weight, kQuantum);
    sums.all += all;
    for (size_t i = 0; i < 3; ++i)
      sums.seen[i] +=
          isDimmed ? sign * toFixed(weight * double{pair.seen[static_cast<int>(i)]}, kQuantum)
                   : all & seen;
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
