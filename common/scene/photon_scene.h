// photon_scene.h: a second, simpler scene, which the photons of a pool meet in place of what is
// seen (--photon-scene). It has fewer surfaces and about the same light.
//
//   what photons meet = the lamps of the scene, as they are + all of the simpler one
//
// All that is in the simpler scene stays where it is while things of the scene move. It emits
// nothing: lamps are the scene's. Both share one system of coordinates, that of their files.
//
// Source:  Jozwowski 2002, 4.4 (scene simplification).
// Proved:  tests/scene/photon_scene_test.cpp; tests/gi/photon_scene_test.cpp (light).
// Threads: reentrant.   Errors: as readScene and validate() of reader.h.
#pragma once

#include <optional>
#include <string>

#include "common/scene/scene.h"

namespace ninefold {

// Adds `simple` to what goes to clients with `scene`.
void addPhotonScene(Scene& scene, const Scene& simple);
// The scene with that of the file; as it is without one.
Scene withPhotonScene(Scene scene, const std::optional<std::string>& file);

// What photons meet; only for a scene with photonInstances.
Scene photonSceneOf(const Scene& scene);

}  // namespace ninefold
