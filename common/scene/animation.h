// animation.h: how nodes of a scene file move over time, as plain data, and where they are at a
// time. Places are edits of the scene: an animation plays by the same small deltas as a person's
// hand.
//
//   local(t)  = translation(t) rotation(t) scale(t)         world(t) = world(parent, t) local(t)
//   motion(t) = world(t) world(as read)^-1                  of an ObjectEdit
//
// Between the keys i and j = i + 1, with d = t_j - t_i and s = (t - t_i) / d:
//   step     v_i
//   linear   v_i + s (v_j - v_i), rotations along the shorter great arc
//   cubic    (2s^3 - 3s^2 + 1) v_i + d (s^3 - 2s^2 + s) out_i
//            + (3s^2 - 2s^3) v_j + d (s^3 - s^2) in_j
// in_i, out_i: tangents of key i. Before the first and after the last key the value stays. A scale
// of 0 becomes almost 0, since a motion must be invertible (gltf_transform.h).
//
// Shapes that morph or hang on joints follow by deformation.h, as edits of their meshes.
//
// Source:  glTF 2.0 specification, 3.11 and appendix C.   Proved: tests/scene/animation_test.cpp,
//          tests/scene/gltf_deform_test.cpp.
// Threads: pure functions of plain data.   Errors: none.
#pragma once

#include <optional>
#include <string>

#include "common/scene/edit.h"

namespace ninefold {

// Why the scene has nothing that can be played, or not all of it. Empty if all is well.
std::string whyNotPlayed(const Scene& scene);

// Places at `time` [s] of all that moves, objects and punctual lights, and shapes of what is
// deformed. Intensities are as read.
SceneEdit animationAt(const Scene& scene, double time);

// `camera` at `time` [s]: moved if it is one of the scene's own that moves; else as it is.
Camera animatedCamera(const Scene& scene, const Camera& camera, double time);

// Time of the last key [s].
double animationEnd(const Scene& scene);

}  // namespace ninefold
