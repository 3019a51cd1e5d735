// layers.h: the reflection lobe of an opaque surface under sheen, a clear coat, or both.
//
//   f   = f_coat + T_c (sheen f_sheen + T_s f_base)
//   T_c = 1 - coat max(F(cos_o), F(cos_i))            f_coat: GGX times F of the half vector
//   T_s = 1 - max3(sheen) max(E(cos_o), E(cos_i))     sheen.h
//   F(c) = 0.04 + 0.96 (1-c)^5                        index 1.5
//
// What a layer reflects it keeps from those below, at the more grazing of the two directions. So f
// is symmetric, and a smooth coat over anything gives no more than comes in. D lies below, too, and
// its weight must not depend on directions: it loses the mean albedos of the layers.
//
// One part is chosen in proportion to its albedo; the density is that of all parts together, so
// that weights stay near 1.  Internal to common/bsdf.
//
// Source:  KHR_materials_clearcoat and KHR_materials_sheen of glTF's registry.
// Proved:  tests/bsdf (chi-square, reciprocity, albedo <= 1, a coat of weight 0 is none).
// Fails:   light that goes to and fro between coat and base is lost; emission is not dimmed by what
//          lies over it. The coat has the normal of the base.
// Threads: pure functions.   Errors: none.
#pragma once

#include "common/bsdf/bsdf.h"

namespace ninefold {

std::optional<LobeSample> sampleLayers(const Bsdf& bsdf, Vec3 wo, Vec2 u, float uLobe);
LobeValue evaluateLayers(const Bsdf& bsdf, Vec3 wo, Vec3 wi);
Reflectance layersAlbedo(const Bsdf& bsdf, float cosThetaO);

}  // namespace ninefold
