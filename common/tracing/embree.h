// embree.h: the calls that differ between Embree 3 (Debian 12) and Embree 4 (Debian 13), under one
// name each. Only .cpp files of this folder include it. NINEFOLD_EMBREE is 3 or 4, set by this
// folder's CMakeLists.txt.
#pragma once

#if NINEFOLD_EMBREE == 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace ninefold::embree {

#if NINEFOLD_EMBREE == 4

inline RTCRayQueryFlags queryFlags(bool coherent) {
  return coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
}

inline void intersect1(RTCScene scene, RTCRayHit* ray) { rtcIntersect1(scene, ray, nullptr); }
inline void occluded1(RTCScene scene, RTCRay* ray) { rtcOccluded1(scene, ray, nullptr); }

inline void intersect16(RTCScene scene, const int* valid, RTCRayHit16* rays, bool coherent) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = queryFlags(coherent);
  rtcIntersect16(valid, scene, rays, &arguments);
}

inline void intersect8(RTCScene scene, const int* valid, RTCRayHit8* rays, bool coherent) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = queryFlags(coherent);
  rtcIntersect8(valid, scene, rays, &arguments);
}

inline RTCOccludedArguments occlusion(bool coherent) {
  RTCOccludedArguments made;
  rtcInitOccludedArguments(&made);
  made.flags = queryFlags(coherent);
  return made;
}

inline void occluded16(RTCScene scene, const int* valid, RTCRay16* rays, bool coherent) {
  RTCOccludedArguments arguments = occlusion(coherent);
  rtcOccluded16(valid, scene, rays, &arguments);
}

inline void occluded8(RTCScene scene, const int* valid, RTCRay8* rays, bool coherent) {
  RTCOccludedArguments arguments = occlusion(coherent);
  rtcOccluded8(valid, scene, rays, &arguments);
}

#else

inline RTCIntersectContext context(bool coherent) {
  RTCIntersectContext made;
  rtcInitIntersectContext(&made);
  made.flags =
      coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  return made;
}

inline void intersect1(RTCScene scene, RTCRayHit* ray) {
  RTCIntersectContext made = context(false);
  rtcIntersect1(scene, &made, ray);
}

inline void occluded1(RTCScene scene, RTCRay* ray) {
  RTCIntersectContext made = context(false);
  rtcOccluded1(scene, &made, ray);
}

inline void intersect16(RTCScene scene, const int* valid, RTCRayHit16* rays, bool coherent) {
  RTCIntersectContext made = context(coherent);
  rtcIntersect16(valid, scene, &made, rays);
}

inline void intersect8(RTCScene scene, const int* valid, RTCRayHit8* rays, bool coherent) {
  RTCIntersectContext made = context(coherent);
  rtcIntersect8(valid, scene, &made, rays);
}

inline void occluded16(RTCScene scene, const int* valid, RTCRay16* rays, bool coherent) {
  RTCIntersectContext made = context(coherent);
  rtcOccluded16(valid, scene, &made, rays);
}

inline void occluded8(RTCScene scene, const int* valid, RTCRay8* rays, bool coherent) {
  RTCIntersectContext made = context(coherent);
  rtcOccluded8(valid, scene, &made, rays);
}

#endif

}  // namespace ninefold::embree
