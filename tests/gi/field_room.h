// field_room.h: a room with two lamps under its ceiling and a box that stands on the floor, and the
// changes of it that an intersection field must follow.
#pragma once

#include <functional>

#include "common/scene/edit.h"
#include "common/scene/twist.h"
#include "tests/gi/make_scene.h"

namespace ninefold::testing {

inline constexpr uint32_t kWalls = 0, kFirstLamp = 1, kSecondLamp = 2, kBox = 3;  // instances

// One scene: edits of it share what they leave alone.
inline const Scene& fieldRoom() {
  static const Scene room = [] {
    SceneBuilder b;
    b.box(b.material(matte(Vec3(0.6f))), Vec3(-1), Vec3(1), true);
    for (const Vec3& at : {Vec3(-0.6f, 0.9f, -0.2f), Vec3(0.4f, 0.9f, -0.1f)})
      b.quad(b.material(matte(Vec3(0), Vec3(5))), at, Vec3(0.3f, 0, 0), Vec3(0, 0, 0.3f));
    b.box(b.material(matte(Vec3(0.7f, 0.3f, 0.2f))), Vec3(0.1f, -1, 0.2f),
          Vec3(0.55f, -0.3f, 0.65f), false);
    b.camera(Vec3(0, 0, 0.95f), Vec3(0, -0.3f, -1), 1.2f);
    Scene scene = b.build();
    for (size_t i = 0; i < scene.instances.size(); ++i)
      scene.instances[i].node = static_cast<int>(i);
    return scene;
  }();
  return room;
}

inline SceneEdit movedBy(uint32_t instance, DVec3 by) {
  SceneEdit edit;
  edit.objects.push_back({static_cast<int>(instance), DMat4(1)});
  edit.objects[0].motion[3] = DVec4(by, 1);
  return edit;
}

inline SceneEdit repainted(uint32_t instance, const std::function<void(MaterialEdit&)>& paint) {
  const Scene& room = fieldRoom();
  const auto mesh = static_cast<size_t>(room.instances[instance].mesh);
  SceneEdit edit;
  edit.materials.push_back(editOfMaterial(room, static_cast<uint32_t>(room.meshes[mesh].material)));
  paint(edit.materials[0]);
  return edit;
}

// One corner hangs lower than the others.
inline SceneEdit bent(uint32_t instance) {
  const auto mesh = static_cast<uint32_t>(fieldRoom().instances[instance].mesh);
  std::vector<Vec3> positions = fieldRoom().meshes[mesh].positions;
  positions[2] += Vec3(0.05f, -0.1f, 0.02f);
  SceneEdit edit;
  edit.shapes = shapeEdits(mesh, positions, {});
  return edit;
}

inline SceneEdit twistedBox() {
  const auto mesh = static_cast<uint32_t>(fieldRoom().instances[kBox].mesh);
  SceneEdit edit;
  edit.shapes = twisted(fieldRoom(), mesh, DMat4(1), {DVec3(0.3, 0, 0.4), -1, -0.3, 0.6});
  return edit;
}

}  // namespace ninefold::testing
