// direct_light.h: lights sampled from one surface point x, for the S vertices of eye paths and the
// D vertices of the reference path tracer. First an emitter (light_streams.h), then a place on it.
//
//   area          pdf = (P/A) d^2 / cos_y     weight = L / pdf
//   environment   pdf = P q(w)                weight = L(w) / pdf
//   point, spot, goniometric
//                 pdf = 0                     weight = I(w) / (d^2 P)
//   directional   pdf = 0                     weight = E0 / P
//
//   P, A   probability of the emitter, area of its triangle [m^2]
//   cos_y  cosine at the emitter
//   q      density of the environment's directions (emitters.h), 1/(4 pi) if it is constant
//   pdf    per solid angle [1/sr]; 0 stands for delta: no other technique finds such a light
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

// A light sample of a stream, on p's viewed side or behind it (for lobes that transmit). nullopt if
// it is dark, or the emitter looks away. All streams together are the light.
std::optional<LightSample> sampleLight(const Transport& transport, size_t stream,
                                       const ShadingPoint& p, Vec2 u);

// Share of the sample's light that the medium on its way leaves. The medium is the one on wo's side
// of p or, with `through`, the one behind p.
Vec3 lightTransmittance(const Transport& transport, const ShadingPoint& p, const MediumStack& media,
                        bool through, const LightSample& light);

// Density with which sampleLight would have found what a BSDF ray met: an emissive triangle ...
float lightPdf(const Transport& transport, const Hit& hit, const SurfacePoint& surface, Vec3 w,
               float distance);
// ... or the environment, out of unit direction w.
float environmentPdf(const Transport& transport, Vec3 w);

// Radiance that the surface emits towards the side of wo; 0 if it is no emitter there.
Radiance emittedRadiance(const Transport& transport, const ShadingPoint& p);

// Balance heuristic: weight of the technique with density `mine` beside one with density `other`.
inline float balance(float mine, float other) { return mine / (mine + other); }

}  // namespace ninefold
