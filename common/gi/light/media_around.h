// media_around.h: the solids that a place lies in: those of which a ray from there meets the back
// face first. A ray that meets no box of a solid is not traced.
//
// Threads: pure function.   Errors: none; after 64 surfaces what is behind them does not count.
#pragma once

#include "common/gi/light/transport.h"

namespace ninefold {

// Unit: the way of that ray.
Vec3 wayOutOfMedia();

MediumStack mediaAround(const Transport& transport, Vec3 place);

}  // namespace ninefold
