// ray_log.h: the ray calls of a stretch of work, kept so that the same rays can be traced again
// alone: the floor of any program that wants these answers from Embree (tools/client_benchmark).
//
// Owner:   whoever measures; a Tracer refers to it while it is attached (Tracer::logTo).
// Threads: one tracing thread at a time.
#pragma once

#include <vector>

#include "common/tracing/tracer.h"

namespace ninefold {

struct RayLog {
  struct Packet {
    RayPacket rays;
    uint32_t active;
    bool occlusion, coherent;
  };
  struct Single {
    Vec3 origin, direction;
    float tFar;
    bool occlusion;
  };
  std::vector<Packet> packets;
  std::vector<Single> singles;

  void clear() { packets.clear(), singles.clear(); }
};

}  // namespace ninefold
