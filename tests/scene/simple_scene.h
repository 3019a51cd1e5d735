// simple_scene.h: a scene in memory to vary: one unit square in the plane z = 0, facing +z.
#pragma once

#include "common/scene/scene.h"
#include "common/scene/world.h"

namespace ninefold {

inline Scene simpleScene() {
  Scene scene;
  Mesh square;
  square.positions = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)};
  square.uv0 = {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
  square.triangles = {Triangle(0, 1, 2), Triangle(0, 2, 3)};
  scene.meshes = {square};
  scene.materials = {Material{}};
  scene.instances = {Instance{}};
  scene.cameras = {Camera{}};
  scene.bounds = boundsOf(scene);
  return scene;
}

}  // namespace ninefold
