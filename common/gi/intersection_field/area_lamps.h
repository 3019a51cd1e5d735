// area_lamps.h: the lamps that are surfaces, and the light that they would send if nothing stood in
// the way.
//
//   lamp          one instance that shines
//   H(x) = sum over 25 disks of pi L A cos_s cos_y / (pi d^2 + A)       [W/m^2]
//
// The disks lie on the lamp in proportion to power, evenly. Near a disk this is what a disk sends
// straight on, L pi at most, and far away the geometry term times L A.
//
// Units:   L [W/(m^2 sr)], A area of a disk [m^2], d [m]; cos_s with the shading normal at x.
// Source:  Ren et al. 2005, 5 (LIM, 25 elements).   Proved: tests/gi/lamp_visibility_test.cpp.
// Threads: const after construction.   Errors: none.
#pragma once

#include <vector>

#include "common/gi/light/transport.h"

namespace ninefold {

struct LampDisk {
  Vec3 position{0}, normal{0};
  Radiance radiance{0};
  float area = 0;   // [m^2]
  float error = 0;  // of position [m]
};

struct AreaLamp {
  static constexpr uint32_t kDisks = 25;

  uint32_t instance = 0;
  bool doubleSided = false;
  bool isEven = true;   // it has the same L all over
  float brightest = 0;  // largest component of what an emitter of it radiates [W/(m^2 sr)]
  std::vector<LampDisk> disks;
};

std::vector<AreaLamp> areaLamps(const Transport& transport);

// What a disk adds to H at x; 0 if it is not in front of x.
Irradiance unshadowed(const AreaLamp& lamp, const LampDisk& disk, Vec3 x, Vec3 ng, Vec3 ns);

}  // namespace ninefold
