// solid_ranks.h: which of two solids counts where they overlap: the smaller one, as if the larger
// had a hole of its form. So a ball that floats in water is a ball all through, and a glass holds
// what is poured into it. The rule does not ask the path: light and eye agree on it.
//
//   V = |sum of a . (b x c)| / 6 over the triangles (a, b, c), seen from one of the corners   [m^3]
//
// Of a material with several objects the largest V counts; equals go by their index. A surface that
// is not closed has a V without meaning, but the same V for all paths.
//
// Source:  the divergence theorem; priorities of overlapping dielectrics: Schmidt and Budge 2002.
// Threads: pure function.   Errors: none for valid scenes.
#pragma once

#include <vector>

#include "common/scene/scene.h"

namespace ninefold {

// One rank for each material, 0 and up. Of overlapping solids the highest rank counts. All are 0
// unless two materials are solid and transmit.
std::vector<int> solidRanks(const Scene& scene);

}  // namespace ninefold
