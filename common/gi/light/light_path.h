// light_path.h: the random walk of particles from the lights, written once. Visitors say what
// becomes of it.
//
// Each hit is told to the visitor. Then one lobe, D or S, is chosen in proportion to its albedo.
// The walk survives with a probability of the albedos' sum (largest channel, at most kMaxSurvival):
//   flux *= lobe weight / probability
// So flux stays of one order along the walk. Arrival on an interpolated normal carries Veach's
// factor (shading.h); for S lobes see particle_scatter.h. Walks end after kMaxVertices at the
// latest (survival 0.99^k is nil).
//
// After D a particle goes where a ray in a cosine-distributed direction goes, or another way that
// the caller knows (walkLightPathBy).
//
// Dimensions of vertex j = 1, 2, ...: 4j, 4j+1 direction; 4j+2 choice of lobe and survival;
// 4j+3 inside the lobe. A sampler may use what the choice of D leaves of its number once more, for
// the direction.
//
// Source:  Keller, "Instant Radiosity", 1997; Veach 1997, 5.3 (shading normals).
// Threads: reentrant.   Errors: none.
#pragma once

#include <optional>
#include <utility>

#include "common/base/counters.h"
#include "common/gi/light/emission.h"
#include "common/gi/light/particle_scatter.h"
#include "common/sampling/sampler.h"
#include "common/sampling/warp.h"

namespace ninefold {

inline constexpr float kMaxSurvival = 0.99f;
inline constexpr int kMaxVertices = 4096;

// Where a particle arrives. flux: of the arriving particle [W], attenuated by the medium. It adds
// flux / n^2 to the (basic) irradiance there.
struct Arrival {
  const ShadingPoint* point;
  Flux flux;
  MediumStack media;  // on the side it came from
  bool turned;        // some lobe turned it: it does not come straight from the lamp
  bool focused;       // the last lobe that turned it was S and not glossy: photons bring this light
  bool hidden;        // the light is punctual and met a smooth lobe first: no eye path finds it
  int diffuseBefore;  // D vertices before this one
  bool known;         // the way on after D told where, not a ray
};

// Probabilities of the three ways on, D, reflection, transmission; their sum is the survival.
struct LobeChoice {
  float diffuse = 0, reflection = 0, transmission = 0;
  float sum() const { return diffuse + reflection + transmission; }
};

inline LobeChoice albedoChoice(const Bsdf& bsdf, float cosThetaO) {
  LobeChoice c;
  c.diffuse = maxComponent(bsdf.diffuse);
  if (bsdf.reflects) c.reflection = maxComponent(lobeAlbedo(bsdf, Lobe::reflection, cosThetaO));
  if (bsdf.transmits())
    c.transmission = maxComponent(lobeAlbedo(bsdf, Lobe::transmission, cosThetaO));
  return c;
}

// How a particle goes on.
struct WayOn {
  Vec3 origin{0}, direction{0};  // direction: unit
  std::optional<Hit> hit = {};   // what it meets, or none; nothing: a ray tells
};

// After D, in a cosine-distributed direction.
inline WayOn cosineWay(const ShadingPoint& p, Vec2 u) {
  const Vec3 wi = Basis(p.ng).toWorld(squareToCosineHemisphere(u));
  return {offsetOrigin(p.surface, wi), wi};
}

// What a particle meets.
struct TraceRay {
  Hit operator()(const Tracer& tracer, Vec3 origin, Vec3 direction) const {
    return tracer.closest(origin, direction, std::numeric_limits<float>::infinity());
  }
};

// Follows a particle that starts in `media` after `diffuseBefore` D vertices. Its numbers are those
// of sample `index`, from `firstDimension` on. `sampler`: get1D, get2D and diffuseDirection as
// LightSampler has them. visit(const Arrival&) returns whether the walk goes
// on after a D scattering here; after S it always does. leave(const ShadingPoint&, Vec2) tells the
// way on after D. trace(const Tracer&, origin, direction) tells what it meets, as TraceRay does.
template <typename Sampler, typename Visit, typename Leave, typename Trace = TraceRay>
void walkLightPathBy(const Transport& t, Particle particle, MediumStack media, int diffuseBefore,
                     const Sampler& sampler, uint32_t index, uint32_t firstDimension,
                     RayCounts& rays, Visit&& visit, const Leave& leave, const Trace& trace = {}) {
  std::optional<Hit> known;  // what the particle meets next
  bool turned = false, focused = false, hidden = false;
  int specularRun = 0;
  for (int vertex = 0; vertex < kMaxVertices; ++vertex) {
    if (isBlack(particle.flux)) return;
    const bool wasKnown = known.has_value();
    if (!wasKnown) {
      ++rays.photon;
      known = trace(t.tracer, particle.origin, particle.direction);
    }
    const Hit hit = *known;
    known.reset();
    if (!hit) return;
    const ShadingPoint p = t.shader.shade(t.tracer.surface(hit), -particle.direction, media);
    if (t.shader.neverEntered(p, media)) {  // it started inside: the light was taken for one in air
      particle.flux /= t.shader.squaredIndex(media);
      t.shader.enter(media, p.surface.material);
      particle.flux *= t.shader.squaredIndex(media);
    }
    particle.flux *= t.shader.attenuation(p, media, hit.t);
    const bool goOn =
        visit(Arrival{&p, particle.flux, media, turned, focused, hidden, diffuseBefore, wasKnown});

    // Choose D or an S lobe, or the end.
    const uint32_t d = firstDimension + 4 * static_cast<uint32_t>(vertex);
    LobeChoice choice = albedoChoice(p.bsdf, p.localWo().z);
    if (const float sum = choice.sum(); sum > kMaxSurvival) {
      const float scale = kMaxSurvival / sum;
      choice.diffuse *= scale, choice.reflection *= scale, choice.transmission *= scale;
    }
    float u = sampler.get1D(index, d + 2);
    if (u < choice.diffuse) {
      if (!goOn) return;
      const Vec2 uDirection = sampler.diffuseDirection(index, d, u / choice.diffuse);
      const WayOn way = leave(p, uDirection);
      particle.flux *= shadingFactor(p, p.ns, p.wo) / choice.diffuse * p.bsdf.diffuse;
      particle.origin = way.origin, particle.direction = way.direction, known = way.hit;
      turned = true, focused = hidden = false, specularRun = 0, ++diffuseBefore;
      continue;
    }
    u -= choice.diffuse;
    const Lobe lobe = u < choice.reflection ? Lobe::reflection : Lobe::transmission;
    const float probability = lobe == Lobe::reflection ? choice.reflection : choice.transmission;
    if (u >= choice.reflection + choice.transmission || ++specularRun > t.settings.specularDepth)
      return;
    const float left = (lobe == Lobe::reflection ? u : u - choice.reflection) / probability;
    const auto scattered =
        scatterParticle(p, lobe, sampler.get2D(index, d), sampler.get1D(index, d + 3), left);
    if (!scattered) return;
    particle.flux *= scattered->weight / probability;
    particle.origin = offsetOrigin(p.surface, scattered->wi), particle.direction = scattered->wi;
    if (lobe == Lobe::transmission) media = t.shader.pass(p, media);
    if (lobe == Lobe::reflection)
      turned = true, focused = !isGlossy(p.bsdf);
    else if (!scattered->smooth || !t.shader.passesStraight(p.surface))
      turned = focused = true;  // else it goes on as it came
    if (vertex == 0) hidden = particle.punctual && scattered->smooth;
  }
}

// The same by rays alone.
template <typename Sampler, typename Visit>
void walkLightPath(const Transport& t, const Particle& particle, const MediumStack& media,
                   int diffuseBefore, const Sampler& sampler, uint32_t index,
                   uint32_t firstDimension, RayCounts& rays, Visit&& visit) {
  walkLightPathBy(t, particle, media, diffuseBefore, sampler, index, firstDimension, rays,
                  std::forward<Visit>(visit), cosineWay);
}

}  // namespace ninefold
