// mtl_translation.h: an MTL material in terms of ours, its maps left aside. MTL has no physical
// definition, and programs differ; these are the rules. "o" is the opacity: d, else 1 - Tr, else 1.
// "Black" is 0.02 at most, and no map. Colours are clamped to [0, 1], Ke to >= 0.
//
//   Kd          base colour; absent: white under map_Kd, grey if the material says nothing else
//   Ke          radiance, of the front face; absent: white under map_Ke
//   Ks          of an ordinary surface: F0 = F0(Ni) min(1, 2 Ks), because exporters write Ks 0.5
//               for one; absent: white under map_Ks
//   Ns          GGX alpha = sqrt(2 / (Ns + 2)); of what reflects (illum 3 5 8) roughness
//               1 - sqrt(Ns / 1000), as Blender writes it; absent: 1, or smooth of a mirror
//   Black colours under a map count as white: exporters write them so.
//
//   illum          o = 1                              o < 1
//   0 1 2 10 none  ordinary                           ordinary, blended by o
//   3 5 8          reflects (below)                   reflects, blended by o
//   4 9            ordinary: Maya writes 4, and Tf    blended by o; glass if Tf is given and not
//                  1 1 1, for anything; glass if Kd   black, or if o = 0
//                  is black, Tf is not, Ni is above
//                  1 and o is not given
//   6              ordinary, or glass if it is told   as 4 9; not glass: reflects, blended by o
//   7              ordinary, or glass if it is told   as 4 9
//   told           Tf is given and not black, and o is not given or Kd is black; or o and Tf are
//                  not given, Kd is black and Ni is above 1
//   reflects       a mirror Ks over Kd if Ks is brighter than Kd, and either above 0.5 or Kd is
//                  black (then Kd is left out); else a metal of colour Kd, as Blender writes one:
//                  its metallic is the mean of Ka, 1 without Ka
//   glass          solid, smooth, index Ni (1.5 if not above 1), tinted by Tf / max Tf, and by Kd
//                  unless that is black: files fill Tf with any grey, its hue alone is trusted
//
//   Pr, Pm or a map of them: the physically based MTL of Blender 3 and others. Metallic Pm (1 under
//   its map, else 0), roughness Pr (1 under its map, else by Ns), Ks of an ordinary surface (0.5 if
//   absent), transmission = mean Tf, tinted by Kd, blended by o; illum says nothing.
//
//   Ps, Pc, Pcr: layers over what is opaque, whatever else it is. White sheen Ps, of roughness 0.5,
//   as MTL has none for it; a clear coat Pc of roughness Pcr, smooth if absent.
//
//   d and Tr both: d counts. Tr 1 alone is opaque, with a warning: MeshLab writes opacity as Tr,
//   and nobody would write what cannot be seen at all.
//   map_d, map_Pr ...: obj_textures.h.
//
// Where programs differ: Blender makes a metal of illum 4 and 7 too; it and MeshLab never refract
// by illum.
// Source:  Wavefront's Advanced Visualizer manual, appendix B4; Walter et al. 2007 for alpha of Ns.
// Threads: pure.   Errors: none.
#pragma once

#include "common/scene/mtl_file.h"
#include "common/scene/scene.h"

namespace ninefold {

Material translate(const MtlMaterial& from);

// The material of a name that no library has.
Material defaultGrey(const std::string& name);

}  // namespace ninefold
