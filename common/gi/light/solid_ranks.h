// solid_ranks.h: which of two solids counts where they overlap: the smaller one, as if the larger had a
// hole of its form. A ball that floats in water is a ball all through, a glass holds what is poured into
// it. The rule asks nothing of the path, so that light and eye agree on what is in a place.
//
//   V = |sum of a . (b x c)| / 6 over the triangles, from one of the corners      [m^3]
//
// Of a material with several objects the largest counts; equals go by their index. A surface that is
// not closed encloses nothing, and its V means nothing, but it is the same for all paths.
//
// Source: the divergence theorem; priorities of overlapping dielectrics: Schmidt and Budge 2002.
// Threads: function.   Errors: none for valid scenes.
#pragma once

#include <vector>

#include "common/scene/scene.h"

namespace ninefold {

// For each material, 0 and up: of overlapping solids the highest counts. All 0 unless two materials are
// solid and transmit.
std::vector<int> solidRanks(const Scene& scene);

}  // namespace ninefold
