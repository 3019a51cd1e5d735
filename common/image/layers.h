// layers.h: what a task gives back, planar: for each of a pixel's at most three layers the
// filterable irradiance E with its guide planes, and the unfiltered radiance U.
//
//   layer radiance = reflectance * E + U       reflectance = throughput * rho/pi, in [0, 1/pi]
//
// The first hit splits into layers: diffuse (the hit itself is x), reflection and transmission (x
// is where the specular chain ends on a diffuse surface). A pixel without x in a layer (emitter
// met, path escaped, lobe absent) has distance 0 and reflectance 0; its U counts all the same.
//
// Owner: whoever holds the value.   Threads: plain data.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/base/counters.h"

namespace ninefold {

enum Layer : int { kDiffuse = 0, kReflection = 1, kTransmission = 2 };
inline constexpr int kLayers = 3;

// Bits of a layer mask: which layers a task carries. kDiffuseBit is always set.
inline constexpr uint8_t kDiffuseBit = 1, kReflectionBit = 2, kTransmissionBit = 4;
inline bool hasLayer(uint8_t mask, int layer) { return (mask >> layer & 1) != 0; }
// In place of layers: finished pixels, as radiance or as codes for a display (tone_map.h).
inline constexpr uint8_t kRadianceMask = 0, kDisplayMask = 8;
inline bool isFinished(uint8_t mask) { return mask == kRadianceMask || mask == kDisplayMask; }

// Bits of an extra-plane mask: planes that only some tasks ask for, all of the first hit.
enum ExtraPlane : uint8_t {
  kAlbedoPlane = 1,       // sum of the lobes' reflectance towards the eye, RGB in [0, 1]
  kNormalPlane = 2,       // shading normal, unit; 0 where nothing was hit
  kDepthPlane = 4,        // distance along the camera's forward axis [m]; 0 where nothing was hit
  kObjectPlane = 8,       // instance index + 1; 0 where nothing was hit
  kCausticPlane = 16,     // part of E in the diffuse layer that came by way of S [W/m^2]
  kIrradiancePlane = 32,  // E there, of methods whose light is all in U [W/m^2]
};
// The planes that tell which object is at a place of the picture, and how far away.
inline constexpr uint8_t kPickPlanes = kObjectPlane | kDepthPlane;

inline constexpr int kExtraPlanes = 6;

struct RgbPlane {
  std::vector<float> r, g, b;
  void resize(size_t n) { r.assign(n, 0), g.assign(n, 0), b.assign(n, 0); }
  // Old values may stay: for callers that write all of them.
  void reshape(size_t n) { r.resize(n), g.resize(n), b.resize(n); }
  bool operator==(const RgbPlane&) const = default;
};

struct LayerPlanes {
  RgbPlane reflectance;         // throughput * rho / pi [1/sr], each in [0, 1/pi]
  RgbPlane irradiance;          // E at x [W/m^2]
  RgbPlane unfiltered;          // U [W/(m^2 sr)]
  std::vector<float> distance;  // path length from the eye to x [m]; 0 = no x
  RgbPlane normal;              // unit normal at x, turned towards where the path came from
  std::vector<uint16_t> chain;  // hash of first object and specular chain; 0 in the diffuse layer

  void resize(size_t n) {
    reflectance.resize(n), irradiance.resize(n), unfiltered.resize(n), normal.resize(n);
    distance.assign(n, 0), chain.assign(n, 0);
  }
  bool operator==(const LayerPlanes&) const = default;
};

struct ExtraPlanes {
  RgbPlane albedo, normal, caustic, irradiance;
  std::vector<float> depth;
  std::vector<uint32_t> object;

  void resize(size_t n, uint8_t mask) {
    albedo.resize((mask & kAlbedoPlane) != 0 ? n : 0);
    normal.resize((mask & kNormalPlane) != 0 ? n : 0);
    caustic.resize((mask & kCausticPlane) != 0 ? n : 0);
    irradiance.resize((mask & kIrradiancePlane) != 0 ? n : 0);
    depth.assign((mask & kDepthPlane) != 0 ? n : 0, 0);
    object.assign((mask & kObjectPlane) != 0 ? n : 0, 0);
  }
  bool operator==(const ExtraPlanes&) const = default;
};

// The result of one task, or of any rectangle of pixels of one phase. Row-major, width * height.
struct TileResult {
  int width = 0, height = 0;
  uint8_t layerMask = kDiffuseBit;
  uint8_t extraMask = 0;
  std::array<LayerPlanes, kLayers> layers;  // those absent from layerMask stay empty
  ExtraPlanes extras;
  RayCounts rays;

  // Sets the shape and zeroes all planes that the masks name; keeps capacity.
  void reset(int w, int h, uint8_t layerBits, uint8_t extraBits) {
    width = w, height = h, layerMask = layerBits, extraMask = extraBits, rays = {};
    const size_t n = static_cast<size_t>(w) * static_cast<size_t>(h);
    for (int layer = 0; layer < kLayers; ++layer)
      layers[static_cast<size_t>(layer)].resize(hasLayer(layerBits, layer) ? n : 0);
    extras.resize(n, extraBits);
  }
  int count() const { return width * height; }
};

}  // namespace ninefold
