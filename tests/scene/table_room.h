// table_room.h: the table room with a spot light beside its lamp, so that what a gesture freezes
// shows by every method: which share of the samples each of them gets.
#pragma once

#include "common/scene/reader.h"

namespace ninefold {

inline Scene tableRoomWithSpot() {
  Scene scene = readScene(NINEFOLD_SCENES "/table_room.glb");
  PunctualLight spot;
  spot.name = "spot", spot.kind = LightKind::spot;
  spot.position = Vec3(0, 0.5f, 0), spot.direction = Vec3(0, -1, 0), spot.intensity = Vec3(2);
  scene.lights.push_back(spot);
  return scene;
}

}  // namespace ninefold
