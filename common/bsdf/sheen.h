// sheen.h: the rim of cloth, light scattered by fibres that stand on the surface.
//
//   f(wo, wi) = D(h) V(wo, wi)                                    of colour 1 [1/sr]
//   D(h)      = (2 + 1/alpha) sin_h^(1/alpha) / (2 pi)            "Charlie"
//   V         = min(1, 1 / (4 cos_o cos_i (1 + Lambda(cos_o) + Lambda(cos_i))))
//   E(wo)     = int f cos_i dwi                                   the albedo
//
// Directions are sampled evenly over the hemisphere, p = 1/(2 pi): the lobe is wide. The bound on V
// and kLeastSheenAlpha keep E <= 1: the fit of Lambda lets energy grow at grazing directions.
// Internal to common/bsdf.
//
// Source:  Estevez and Kulla, "Production Friendly Microfacet Sheen BRDF", SIGGRAPH courses 2017
//          (with the fit of Lambda); KHR_materials_sheen of glTF's registry.
// Proved:  tests/bsdf (chi-square, reciprocity, E against sampling).
// Threads: pure functions.
#pragma once

#include "common/math/units.h"

namespace ninefold::sheen {

inline constexpr float kPdf = 0.5f * kInvPi;  // of each direction of the hemisphere [1/sr]

// f cos_i; wo.z > 0, wi.z > 0.
float value(Vec3 wo, Vec3 wi, float alpha);

// E by a table, within 0.01.
float albedo(float cosThetaO, float alpha);

}  // namespace ninefold::sheen
