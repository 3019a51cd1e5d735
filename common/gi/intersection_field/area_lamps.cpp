#include "common/gi/intersection_field/area_lamps.h"

#include "common/sampling/sampler.h"
#include "common/sampling/warp.h"

namespace ninefold {
namespace {

AreaLamp lampOf(const Transport& t, size_t first, size_t end) {
  AreaLamp lamp;
  lamp.instance = t.emitters[first].instance, lamp.doubleSided = t.emitters[first].doubleSided;
  const auto mesh = static_cast<size_t>(t.scene.instances[lamp.instance].mesh);
  const Material& m = t.scene.materials[static_cast<size_t>(t.scene.meshes[mesh].material)];
  lamp.isEven = !m.emissionMap && m.alphaMode == AlphaMode::opaque;
  std::vector<float> powers;
  for (size_t i = first; i < end; ++i) {
    const Emitter& e = t.emitters[i];
    powers.push_back(maxComponent(e.flux));
    const float sides = e.doubleSided ? 2 : 1;
    lamp.brightest = std::max(lamp.brightest, powers.back() / (sides * kPi * e.area));
  }
  const Distribution byPower(powers);
  if (byPower.empty()) return lamp;
  for (uint32_t k = 0; k < AreaLamp::kDisks; ++k) {
    const float u = (static_cast<float>(k) + 0.5f) / AreaLamp::kDisks;
    const float v = unitFloat(sobolPoint(k, 1));
    const Distribution::Choice choice = byPower.choose(u);
    const auto emitter = static_cast<uint32_t>(first) + choice.index;
    const Emitter& e = t.emitters[emitter];
    const EmitterPoint p = t.emitters.pointAt(emitter, squareToTriangle(Vec2(choice.remapped, v)));
    lamp.disks.push_back({p.position, e.normal, p.radiance,
                          e.area / (AreaLamp::kDisks * choice.probability), p.error});
  }
  return lamp;
}

}  // namespace

std::vector<AreaLamp> areaLamps(const Transport& t) {
  std::vector<AreaLamp> lamps;
  for (size_t i = 0; i < t.emitters.size() && t.emitters[i].kind == EmitterKind::triangle;) {
    size_t end = i;
    while (end < t.emitters.size() && t.emitters[end].kind == EmitterKind::triangle &&
           t.emitters[end].instance == t.emitters[i].instance)
      ++end;
    lamps.push_back(lampOf(t, i, end));
    i = end;
  }
  return lamps;
}

Irradiance unshadowed(const AreaLamp& lamp, const LampDisk& disk, Vec3 x, Vec3 ng, Vec3 ns) {
  const Vec3 way = disk.position - x;
  const float square = glm::dot(way, way);
  if (!(square > 0) || !(glm::dot(ng, way) > 0)) return Irradiance(0);
  const float d = std::sqrt(square);
  const float atLamp = -glm::dot(disk.normal, way) / d;
  const float cosY = lamp.doubleSided ? std::abs(atLamp) : std::max(atLamp, 0.0f);
  const float cosS = std::max(glm::dot(ns, way) / d, 0.0f);
  return kPi * disk.area * cosS * cosY / (kPi * square + disk.area) * disk.radiance;
}

}  // namespace ninefold
