// counters.h: how many rays a piece of work traced, by purpose. Plain sums; a task carries its own.
#pragma once

#include <cstdint>

namespace ninefold {

struct RayCounts {
  uint64_t eye = 0;
  uint64_t shadow = 0;
  uint64_t photon = 0;        // particles from the lights: VPL walks and caustic photons
  uint64_t compensation = 0;  // short rays that give the bounded geometry term its energy back

  RayCounts& operator+=(const RayCounts& o) {
    eye += o.eye, shadow += o.shadow, photon += o.photon, compensation += o.compensation;
    return *this;
  }
  uint64_t total() const { return eye + shadow + photon + compensation; }
};

}  // namespace ninefold
