// reverse_places.h: places that light what the camera sees: ends y of rays from camera points.
//
// A ray starts at one of the camera points, chosen alike, with density cos/pi, and ends at y. What y
// sends on is E(y) rho/pi. Only D counts: glossy lobes are left to the standard VPLs. N_r counts
// all rays, also those that end on nothing or where there is no D; they give no place.
//
// Source:  Segovia et al. 2006, section 3.1.   Threads: pure functions.   Errors: none.
#pragma once

#include <vector>

#include "common/base/counters.h"
#include "common/gi/bidirectional/place.h"
#include "common/gi/eye/receivers.h"
#include "common/gi/light/transport.h"

namespace ninefold {

struct ReversePlace {
  Place place;
  Receiver receiver;  // y as it gathers light
  Reflectance rho{0};
  int drawnFrom = 0;  // camera point
  float density = 0;  // with which that point's rays end there [1/m^2]
};

std::vector<ReversePlace> reversePlaces(const Transport& transport, const Receivers& cameraPoints,
                                        const FrameKey& frame, int k, int count, RayCounts& rays);

}  // namespace ninefold
