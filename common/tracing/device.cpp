#include "common/tracing/device.h"

#include "common/base/error.h"

namespace ninefold {
namespace {

const char* configuration(Isa isa) {
  switch (isa) {
    case Isa::avx2:
      return "threads=1,set_affinity=0,isa=avx2";
    case Isa::avx512:
      return "threads=1,set_affinity=0,isa=avx512";
    case Isa::automatic:
      break;
  }
  return "threads=1,set_affinity=0";
}

}  // namespace

std::string isaOf(RTCDevice device) {
  const bool wide = rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0;
  return wide ? "avx512" : "avx2";
}

Device makeDevice(Isa isa) {
  if (!__builtin_cpu_supports("avx2"))
    fail(
        "this machine's processor lacks AVX2; ninefold needs an x86-64-v3 processor (2013 or "
        "later)");
  if (isa == Isa::avx512 && !__builtin_cpu_supports("avx512vl"))
    fail("--isa avx512: this machine's processor lacks AVX-512; use --isa avx2 or auto");
  Device device(rtcNewDevice(configuration(isa)));
  if (!device)
    fail("ray tracing could not be set up (Embree error {})", int(rtcGetDeviceError(nullptr)));
  if (rtcGetDeviceProperty(device.get(), RTC_DEVICE_PROPERTY_RAY_MASK_SUPPORTED) == 0)
    fail(
        "the installed Embree has no ray masks, by which things that were moved are told; install "
        "Debian's package, or build Embree with EMBREE_RAY_MASK");
  if (isa == Isa::avx512 && isaOf(device.get()) != "avx512")
    fail("--isa avx512: the installed Embree has no AVX-512 kernels; use --isa avx2 or auto");
  return device;
}

void throwOnError(RTCDevice device, const char* doing) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE) return;
  if (error == RTC_ERROR_OUT_OF_MEMORY)
    fail("out of memory while {}; use a smaller scene or a machine with more memory", doing);
  fail("Embree error {} while {}", int(error), doing);
}

}  // namespace ninefold
