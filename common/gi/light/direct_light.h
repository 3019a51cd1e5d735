// direct_light.h: lights sampled from one surface point, for the S vertices of eye paths (and D
// vertices of the reference path tracer). Emitter as light_streams.h says, then a place on it.
//
//   area          density per solid angle = P / A * d^2 / cos_y      (P = probability of the
//   emitter) environment   P / (4 pi) punctual      delta: no other technique finds it, radiance
//   stands for I/d^2 or E0, pdf = 0
//
// Multiple importance sampling with the balance heuristic, see balance().
// Source:  Veach and Guibas 1995.   Threads: pure functions.   Errors: none.
#pragma once

#include <optional>

#include "common/gi/light/transport.h"

namespace ninefold {

// Light arriving at a point from unit direction w.
struct LightSample {
  Vec3 w{0};
  Vec3 weight{0};  // radiance / pdf [W/m^2 sr / (1/sr)], or I/(d^2 P), E0/P for punctual lights
  float pdf = 0;   // per solid angle; 0 for punctual lights
  Vec3 origin{0};  // the shadow ray: origin + t * segment, t in [0, tFar]
  Vec3 segment{0};
  float tFar = 1;
};

// A light sample of a stream on p's viewed side or behind it (`through`: lobes that transmit); nullopt
// if dark or behind. All streams together are the light.
std::optional<LightSample> sampleLight(const Transport& transport, size_t stream,
                                       const ShadingPoint& p, Vec2 u);

// Share of the sample's light that the medium on its way leaves: the one on wo's side of p or,
// `through`, the one behind it.
Vec3 lightTransmittance(const Transport& transport, const ShadingPoint& p, const MediumStack& media,
                        bool through, const LightSample& light);

// Density with which sampleLight would have found what a BSDF ray met: an emissive triangle ...
float lightPdf(const Transport& transport, const Hit& hit, const SurfacePoint& surface, Vec3 w,
               float distance);
// ... or the environment.
float environmentPdf(const Transport& transport);

// Radiance that the surface emits towards the side of wo; 0 if it is no emitter there.
Radiance emittedRadiance(const Transport& transport, const ShadingPoint& p);

// Balance heuristic: weight of the technique with density `mine` beside one with density `other`.
inline float balance(float mine, float other) { return mine / (mine + other); }

}  // namespace ninefold
