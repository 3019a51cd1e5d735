// scene_draft.h: a scene as its file tells it, and what every reader does to it at the end: move
// it to the origin, give it a camera and light if it has none, and check it.
// Threads: value type, pure functions but for the log.
#pragma once

#include <vector>

#include "common/scene/scene.h"

namespace ninefold {

// In file coordinates. Places of lights and cameras are also kept in double precision, so that a
// scene far from the file's origin loses nothing.
struct SceneDraft {
  Scene scene;
  std::vector<DVec3> lightPositions;  // one per scene.lights
  std::vector<DVec3> eyes;            // one per scene.cameras

  // Appends an instance, unless its matrix flattens it. Throws Error beyond the limits of reader.h.
  void addInstance(int mesh, int node, const std::string& name, const DMat4& toWorld);

  uint64_t triangles = 0;    // of all instances
  size_t flatInstances = 0;  // left out
};

// Throws Error if there is no geometry or anything is out of bounds. isLit: light comes from
// outside the file.
Scene finishScene(SceneDraft draft, bool isLit = false);

// A camera that sees all of the bounds: from +z, or from above where the scene is flat. Vertical
// field of view 40 degrees; fits images at least as wide as high.
Camera framingCamera(const Bounds& bounds);

}  // namespace ninefold
