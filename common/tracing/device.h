// device.h: Embree's device for one instruction set. Private to this folder.
//
// Owner:   the device and, through Hierarchy, the scene; both are released with the value.
// Threads: one builds, any number trace.
// Errors:  throws Error if the machine lacks the instruction set or memory.
#pragma once

#include <memory>
#include <string>
#include <type_traits>

#include "common/tracing/embree.h"
#include "common/tracing/tracer.h"

namespace ninefold {

struct ReleaseDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseDevice>;
using Hierarchy = std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene>;

// Builds with one thread only: the hierarchy is the same on every client of a class.
Device makeDevice(Isa isa);

// "avx2" or "avx512": what the device really runs.
std::string isaOf(RTCDevice device);

// Throws Error if the device has met one; `doing`: what was being done.
void throwOnError(RTCDevice device, const char* doing);

}  // namespace ninefold
