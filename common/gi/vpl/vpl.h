// vpl.h: virtual point lights: points that light others as what stands there does.
//
// Kinds and their part of the irradiance at x. Symbols as in vpl_gather.h, which also has what
// shading normals change. w: unit direction from x to the VPL.
//   surface      V (Phi/pi) min(cos_x cos_y / d^2, b)   area emitters, D vertices of light paths
//   point, spot, goniometric
//                V I(w) cos_x / d^2                     never bounded
//   directional  V E0 cos_x                             sun, and samples of the environment
//
// Source:  Keller 1997; Wald et al. 2002, section 4.
// Threads: plain data.
#pragma once

#include <limits>
#include <vector>

#include "common/gi/light/media.h"
#include "common/gi/vpl/glossy_vpl.h"

namespace ninefold {

struct Vpl {
  enum class Kind : uint8_t { surface, point, spot, goniometric, directional } kind = Kind::surface;
  bool emits = false;    // surface: on an emitter (path length 1 at x)
  bool reverse = false;  // surface: found from the camera
  Vec3 position{0};      // directional: unused
  // surface: of the emitting side; spot: axis; directional: where the light comes from
  Vec3 normal{0};
  float bound = std::numeric_limits<float>::infinity();  // surface: of its geometry term [1/m^2]
  Vec3 power{0};    // surface: Phi/pi [W/sr]; directional: E0 [W/m^2]; others: I [W/sr]
  float error = 0;  // of position, see SurfacePoint
  float coneScale = 0, coneOffset = 0;  // spot: falloff = clamp(cos * scale + offset)^2
  uint32_t light = 0;                   // goniometric: index into Transport::lights
  int diffuseCount = 0;  // surface: D vertices of the light path, this one too; 0 on an emitter
  int glossy = -1;       // surface: what its S lobe sends on, in VplSet::glossy; -1: nothing
  MediumStack media;     // surface: around the VPL
  uint32_t lamp = 0;     // lampOf the emitter that its light comes from
  float seen = 1;  // guess of the share of receivers that it is not hidden from, see vpl_roulette.h
  int firstVertex = 1;  // D vertices of an eye path from which on it counts

  // Least number of D vertices that a path by way of the VPL has; a glossy VPL is none itself.
  int leastCount() const { return glossy >= 0 ? diffuseCount - 1 : diffuseCount; }
};

// The VPLs of a light set, and what the S lobes of some of them send on.
struct VplSet {
  std::vector<Vpl> vpls;
  std::vector<GlossyVpl> glossy;
};

}  // namespace ninefold
