// cover.h: what holds all of a scene that edits led out of its bounds.
//
// R of the formulas goes by the bounds of the scene as it was read: edits leave sizes as they are.
// Only what must hold all there is grows, by quarters, and about the middle of the bounds. So a
// door that swings out of a room's box, but not out of the ball around it, changes no photon of the
// sun, and no ray.
//
//   coverBox      low, high; of each axis by itself
//   coverRadius   of a ball: R 1.25^i. All lies within 1 + kBallRounding times it   [m]
//
// Proved:  tests/scene/edit_test.cpp.   Threads: plain values.   Errors: none.
#pragma once

#include "common/math/bounds.h"
#include "common/math/units.h"

namespace ninefold {

struct Scene;

// Corners of the bounds lie on the ball, wherever rounding puts them.
inline constexpr float kBallRounding = 5e-5f;

struct Cover {
  Bounds box;           // empty: the scene's bounds hold everything
  float ballScale = 1;  // radius of the ball, over R
};

Bounds coverBox(const Scene& scene);
Metres coverRadius(const Scene& scene);

// Widens the scene's cover, until it holds the instance where it is.
void coverInstance(Scene& scene, size_t instance);

}  // namespace ninefold
