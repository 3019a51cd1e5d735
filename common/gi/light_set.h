// light_set.h: the light of one interleaved set k: virtual point lights and caustic photons, a pure
// function of (scene, settings, frame's randomization, k).
//
// VPL kinds and their part of the irradiance at x, w = unit direction from x to the VPL:
//   surface      V (Phi/pi) min(cos_x cos_y / d^2, b)   area emitters, D vertices of light paths
//   point, spot  V I(w) cos_x / d^2                     never bounded
//   directional  V E0 cos_x                             sun, and samples of the environment
//
// Direct VPLs: N samples of the emitters in proportion to power; equal punctual ones are merged
// into one. Indirect VPLs: all D vertices of 2^m light paths; Phi = rho * arriving flux / (n^2 2^m),
// n = index of the medium around (radiance is basic, the particles' flux is not). They also stand
// where a glossy S lobe is, and send on what it does: glossy_vpl.h. m is
// such that the mean number of VPLs is nearest (in ratio) to the wanted one; walks are never cut to
// a count. Caustic photons: see caustic_photons.h. In a gesture N and m are what they were when it
// began, and there may be a second stream: light_streams.h.
//
// Source:  Keller 1997; Wald et al. 2002, section 4.
// Proved:  tests/gi (furnace, energy, order independence).
// Threads: plain data once made; making is reentrant.   Owner: shared by the tasks of a set.
#pragma once

#include <vector>

#include "common/gi/glossy_vpl.h"
#include "common/gi/light_path.h"
#include "common/gi/photon_radii.h"

namespace ninefold {

struct Vpl {
  enum class Kind : uint8_t { surface, point, spot, directional } kind = Kind::surface;
  bool emits = false;  // surface: on an emitter (path length 1 at x)
  Vec3 position{0};    // directional: unused
  Vec3 normal{
      0};  // surface: of the emitting side; spot: axis; directional: where the light comes from
  float bound = std::numeric_limits<float>::infinity();  // surface: of its geometry term [1/m^2]
  Vec3 power{0};    // surface: Phi/pi [W/sr]; point, spot: I [W/sr]; directional: E0 [W/m^2]
  float error = 0;  // of position, see SurfacePoint
  float coneScale = 0, coneOffset = 0;  // spot: falloff = clamp(cos * scale + offset)^2
  int diffuseCount =
      0;              // surface: D vertices of the light path, this one included; 0 on an emitter
  int glossy = -1;    // surface: what its S lobe sends on, in LightSet::glossy; -1: nothing
  MediumStack media;  // surface: around the VPL

  // The D vertices that a path by way of the VPL has at least: none here if it is glossy.
  int leastCount() const { return glossy >= 0 ? diffuseCount - 1 : diffuseCount; }
};

struct LightSet {
  std::vector<Vpl> vpls;
  std::vector<GlossyVpl> glossy;  // of some of them
  CausticPhotons photons;
  RayCounts rays;  // what making it cost
};

// m of 2^m light paths a set, from a pilot of fixed size: same on every client. -1: none is needed.
int lightPathsLog2(const Transport& transport);

// pathsLog2: m of the first stream.
LightSet makeLightSet(const Transport& transport, const FrameKey& frame, int k, int pathsLog2);

}  // namespace ninefold
