#include "common/gi/light_set.h"

#include <bit>
#include <unordered_map>

#include "common/gi/caustic_photons.h"

namespace ninefold {
namespace {

constexpr int kPilotLog2 = 10;
constexpr int kMaxPathsLog2 = 20;

int log2Ceil(int n) { return n <= 1 ? 0 : std::bit_width(static_cast<unsigned>(n - 1)); }

Vpl punctualVpl(const PunctualLight& light) {
  Vpl vpl;
  vpl.kind = light.kind == LightKind::point  ? Vpl::Kind::point
             : light.kind == LightKind::spot ? Vpl::Kind::spot
                                             : Vpl::Kind::directional;
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
    vpl.normal = squareToSphere(u);
    vpl.power = share / kSpherePdf * t.emitters.environment();
    return vpl;
  }
  if (e.kind != EmitterKind::triangle) {
    Vpl vpl = punctualVpl(t.lights[e.light]);
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

void addDirectVpls(const Transport& t, size_t stream, const FrameKey& frame, int k,
                   std::vector<Vpl>& vpls) {
  const int count = t.streams.samples(stream, t.settings.directVpls);
  const LightSampler sampler(LightStreams::seedOf(stream, t.settings.seed), SampleUse::directVpl,
                             frame.randomization, static_cast<uint32_t>(k), log2Ceil(count),
                             t.settings.randomization);
  std::unordered_map<uint32_t, size_t> places;  // of punctual emitters' VPLs
  for (uint32_t i = 0; i < static_cast<uint32_t>(count); ++i) {
    const Vec2 u = sampler.get2D(i, 0);
    const auto choice = t.streams.choose(stream, u.x);
    if (!choice) continue;
    const Vpl vpl = directVpl(t, choice->index, Vec2(choice->remapped, u.y),
                              1 / (static_cast<float>(count) * choice->probability));
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

// Walks 2^pathsLog2 particles of block k of a stream and hands each D or glossy vertex to
// deposit(arrival).
template <typename Deposit>
void walkIndirect(const Transport& t, size_t stream, SampleUse use, uint32_t randomization, int k,
                  int pathsLog2, RayCounts& rays, Deposit&& deposit) {
  const LightSampler sampler(LightStreams::seedOf(stream, t.settings.seed), use, randomization,
                             static_cast<uint32_t>(k), pathsLog2, t.settings.randomization);
  for (uint32_t i = 0; i < 1u << pathsLog2; ++i) {
    const Particle start = emitParticle(t, stream, sampler.get2D(i, 0), sampler.get2D(i, 2));
    walkLightPath(t, start, {}, 0, sampler, i, 4, rays, [&](const Arrival& a) {
      const Bsdf& bsdf = a.point->bsdf;
      if ((!isBlack(bsdf.diffuse) && t.allows(a.diffuseBefore + 2)) ||
          (isGlossy(bsdf) && t.allows(a.diffuseBefore + 1)))
        deposit(a);
      return t.allows(a.diffuseBefore + (t.needs.glossy ? 2 : 3));
    });
  }
}

Vpl indirectVpl(const Transport& t, const Arrival& a, float share) {
  const ShadingPoint& p = *a.point;
  Vpl vpl;
  vpl.position = p.surface.position, vpl.error = p.surface.error;
  vpl.normal = p.ng;
  vpl.power = share / t.shader.squaredIndex(a.media) * kInvPi * shadingFactor(p, p.ns, p.wo) *
              p.bsdf.diffuse * a.flux;
  vpl.diffuseCount = a.diffuseBefore + 1, vpl.bound = t.bound;
  vpl.media = a.media;
  return vpl;
}

// One VPL for both lobes, D and glossy. What its bound cuts off comes back by eye paths
// (compensation.h): where they cannot find the light, the glossy lobe has a VPL of its own,
// without.
void depositVpls(const Transport& t, const Arrival& a, float share, LightSet& set) {
  Vpl vpl = indirectVpl(t, a, share);
  const ShadingPoint& p = *a.point;
  const bool glossy = isGlossy(p.bsdf);
  if (glossy && a.hidden) {
    set.vpls.push_back(vpl);
    vpl.power = Vec3(0), vpl.bound = std::numeric_limits<float>::infinity();
  }
  if (glossy) {
    vpl.glossy = static_cast<int>(set.glossy.size());
    set.glossy.push_back(
        {p.bsdf, p.ns, p.ng, p.wo, share / t.shader.squaredIndex(a.media) * a.flux});
  }
  set.vpls.push_back(vpl);
}

void addIndirectVpls(const Transport& t, size_t stream, const FrameKey& frame, int k,
                     int pathsLog2OfFirst, LightSet& set) {
  const auto wanted = static_cast<unsigned>(t.streams.samples(stream, 1 << pathsLog2OfFirst));
  const int pathsLog2 = std::bit_width(wanted) - 1;
  const float share = 1 / static_cast<float>(1u << pathsLog2);
  walkIndirect(t, stream, SampleUse::lightPath, frame.randomization, k, pathsLog2, set.rays,
               [&](const Arrival& a) { depositVpls(t, a, share, set); });
}

}  // namespace

int lightPathsLog2(const Transport& t) {
  if (t.emitters.empty() || t.settings.indirectVpls == 0 || !t.allows(t.needs.glossy ? 1 : 2))
    return -1;
  RayCounts rays;
  uint64_t vertices = 0;
  for (size_t stream = 0; stream < t.streams.count(); ++stream)
    walkIndirect(t, stream, SampleUse::probe, 0, 0, kPilotLog2, rays,
                 [&](const Arrival&) { ++vertices; });
  if (vertices == 0) return -1;
  const double mean = static_cast<double>(vertices) / (1 << kPilotLog2);
  const double wanted = std::log2(t.settings.indirectVpls / mean);
  return std::clamp(static_cast<int>(std::lround(wanted)), 0, kMaxPathsLog2);
}

LightSet makeLightSet(const Transport& t, const FrameKey& frame, int k, int pathsLog2) {
  LightSet set;
  if (t.emitters.empty()) return set;
  for (size_t stream = 0; stream < t.streams.count(); ++stream)
    addDirectVpls(t, stream, frame, k, set.vpls);
  if (pathsLog2 >= 0) {
    for (size_t stream = 0; stream < t.streams.count(); ++stream)
      addIndirectVpls(t, stream, frame, k, pathsLog2, set);
    std::erase_if(set.vpls, [](const Vpl& vpl) { return isBlack(vpl.power) && vpl.glossy < 0; });
  }
  addCausticPhotons(t, frame, k, set);
  return set;
}

}  // namespace ninefold
