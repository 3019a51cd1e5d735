#include "common/gi/vpl/direct_vpls.h"

#include <unordered_map>

#include "common/sampling/sampler.h"
#include "common/sampling/warp.h"

namespace ninefold {
namespace {

Vpl::Kind kindOf(LightKind kind) {
  switch (kind) {
    case LightKind::point:
      return Vpl::Kind::point;
    case LightKind::spot:
      return Vpl::Kind::spot;
    case LightKind::goniometric:
      return Vpl::Kind::goniometric;
    case LightKind::directional:
      break;
  }
  return Vpl::Kind::directional;
}

Vpl punctualVpl(const Transport& t, uint32_t index) {
  const PunctualLight& light = t.lights[index];
  Vpl vpl;
  vpl.kind = kindOf(light.kind), vpl.light = index;
  vpl.position = light.position;
  vpl.normal = light.kind == LightKind::directional ? -light.direction : light.direction;
  vpl.power = light.intensity;
  const float inner = std::cos(light.innerCone), outer = std::cos(light.outerCone);
  vpl.coneScale = 1 / std::max(inner - outer, 0.001f);
  vpl.coneOffset = -outer * vpl.coneScale;
  return vpl;
}

// One sample of the emitters; `share` = 1 / (number of samples * probability).
Vpl directVpl(const Transport& t, uint32_t index, Vec2 u, float share) {
  const Emitter& e = t.emitters[index];
  if (e.kind == EmitterKind::environment) {
    Vpl vpl;
    vpl.kind = Vpl::Kind::directional;
    vpl.normal = t.emitters.sampleEnvironment(u);
    vpl.power = share / t.emitters.environmentPdf(vpl.normal) * t.emitters.environment(vpl.normal);
    return vpl;
  }
  if (e.kind != EmitterKind::triangle) {
    Vpl vpl = punctualVpl(t, e.light);
    vpl.power *= share;
    return vpl;
  }
  const bool back = e.doubleSided && u.x >= 0.5f;
  if (e.doubleSided) u.x = std::min(2 * u.x - (back ? 1.0f : 0.0f), 0x1.fffffep-1f);
  const EmitterPoint p = t.emitters.pointAt(index, squareToTriangle(u));
  Vpl vpl;
  vpl.emits = true, vpl.bound = t.lightBound(index);
  vpl.position = p.position, vpl.error = p.error;
  vpl.normal = back ? -e.normal : e.normal;
  vpl.power = share * (e.doubleSided ? 2.0f : 1.0f) * e.area * p.radiance;
  return vpl;
}

void addOfStream(const Transport& t, size_t stream, const FrameKey& frame, int k, int countOfFirst,
                 const MinorLamps& leftOut, std::vector<Vpl>& vpls) {
  const int count = t.streams.samples(stream, countOfFirst);
  const LightSampler sampler(LightStreams::seedOf(stream, t.settings.seed), SampleUse::directVpl,
                             frame.randomization, static_cast<uint32_t>(k), log2Ceil(count),
                             t.settings.randomization);
  std::unordered_map<uint32_t, size_t> places;  // of punctual emitters' VPLs
  for (uint32_t i = 0; i < static_cast<uint32_t>(count); ++i) {
    const Vec2 u = sampler.get2D(i, 0);
    const auto choice = t.streams.choose(stream, u.x);
    if (!choice) continue;
    const uint32_t lamp = lampOf(t.emitters[choice->index]);
    if (leftOut.has(lamp)) continue;
    Vpl vpl = directVpl(t, choice->index, Vec2(choice->remapped, u.y),
                        1 / (static_cast<float>(count) * choice->probability));
    vpl.lamp = lamp;
    const EmitterKind kind = t.emitters[choice->index].kind;
    const bool fixed = kind != EmitterKind::triangle && kind != EmitterKind::environment;
    if (fixed) {
      const auto [place, isNew] = places.try_emplace(choice->index, vpls.size());
      if (!isNew) {
        vpls[place->second].power += vpl.power;
        continue;
      }
    }
    vpls.push_back(vpl);
  }
}

}  // namespace

void addDirectVpls(const Transport& t, const FrameKey& frame, int k, int times,
                   std::vector<Vpl>& vpls, const MinorLamps& leftOut) {
  const bool onlyBehind = t.settings.directVpls == 0;
  if (onlyBehind && !t.allows(2)) return;
  const int count = onlyBehind ? Settings{}.directVpls : t.settings.directVpls;
  for (size_t stream = 0; stream < t.streams.count(); ++stream)
    addOfStream(t, stream, frame, k, times * count, leftOut, vpls);
  if (onlyBehind)
    for (Vpl& vpl : vpls) vpl.firstVertex = 2;
}

}  // namespace ninefold
