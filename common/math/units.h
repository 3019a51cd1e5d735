// units.h: the quantities by name, and the notation that every formula in the project uses.
//
//   letter   meaning                                             unit             type
//   x, y     points on surfaces: x receives, y sends             m                Vec3
//   d        distance                                            m                Metres
//   L        radiance (basic radiance L/n^2 inside media)        W/(m^2 sr)       Radiance
//   E        irradiance                                          W/m^2            Irradiance
//   Phi      flux of a particle or a light                       W                Flux
//   I        radiant intensity of a punctual light               W/sr             Intensity
//   rho      reflectance                                         1                Reflectance
//   f        BSDF                                                1/sr             Vec3
//   G        geometry term cos_x cos_y / d^2                     1/m^2            float
//   b        bound of G, b = c/R^2                               1/m^2            float
//   R        radius of the scene's bounds                        m                Metres
//   r        photon radius                                       m                Metres
//   k, K     index and number of interleaved light sets          -                int
//
// Colours are linear Rec. 709. Source of the notation: Wald et al. 2002; Kollig and Keller 2004.
#pragma once

#include "common/math/vec.h"

namespace ninefold {

using Metres = float;
using Radiance = Vec3;
using Irradiance = Vec3;
using Flux = Vec3;
using Intensity = Vec3;
using Reflectance = Vec3;

inline constexpr float kPi = 3.14159265358979323846f;
inline constexpr float kInvPi = 0.31830988618379067154f;

}  // namespace ninefold
