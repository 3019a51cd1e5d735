// reverse_density.h: density of the places y where rays from camera points end.
//
//   q(y) = 1/M sum_i V(x_i, y) cos_xi cos_y / (pi d_i^2)        per m^2 of surface
//
//   x_i     one of M camera points, chosen alike; the ray leaves it with density cos/pi
//   V       1 if the segment is free. Panes block it: they also end the rays that draw y.
//
// Given the points this is the density itself, no estimate of it. So 1/q is no source of bias, as
// long as the same points draw y and make q.
//
// Source:  Segovia et al. 2006, equation 7. There the points are drawn from all that is visible, q
//          is an estimate, and 1/q is biased.
// Proved:  tests/gi/bidirectional_test.cpp (q integrates to what rays hit).
// Threads: pure functions.   Errors: none; 0 where no camera point sees y's side.
#pragma once

#include "common/base/counters.h"
#include "common/gi/bidirectional/camera_points.h"
#include "common/gi/bidirectional/place.h"
#include "common/gi/eye/receivers.h"
#include "common/gi/light/transport.h"

namespace ninefold {

// drawnFrom: the point whose ray ended at y, which therefore sees it; kNone for other places.
inline constexpr int kNone = -1;
float reverseDensity(const Transport& transport, const Receivers& cameraPoints, const Place& y,
                     int drawnFrom, RayCounts& rays);

// A guess without rays: from the judges among the camera points, and the point that drew y.
// `reached`: the judges that y's light reaches, as bits.
float guessReverseDensity(const CameraPoints& camera, const Place& y, int drawnFrom,
                          uint32_t reached);

}  // namespace ninefold
