// edit.h: changes of a scene while it is looked at, small and absolute. An edit says what a thing
// is like afterwards, in terms of the scene as it was read. So edits can be merged, sent twice, or
// given to somebody who comes late. All who have the same edits have the same scene, bit for bit.
//
//   objects    toWorld = motion * toWorld as read, for all instances of a node
//   lights     punctual ones: place, direction, how they are turned about it, intensity (off = 0)
//   materials  the numbers that a person turns; maps stay
//   shapes     vertices of a mesh, in pieces (shape_edit.h); its triangles stay
//
// The scene's bounds stay, and with them all sizes that go by them. What leads out of them widens
// the cover (cover.h).
//
// Proved:  tests/scene/edit_test.cpp.   Threads: plain values.
// Errors:  checkEdit throws Error naming what does not exist or is out of range.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/scene/scene.h"
#include "common/scene/shape_edit.h"

namespace ninefold {

// A node of the file and all instances that came from it.
struct ObjectEdit {
  int node = 0;     // Instance::node
  DMat4 motion{1};  // affine, invertible; in scene coordinates
  bool operator==(const ObjectEdit&) const = default;
};

struct LightEdit {
  uint32_t light = 0;  // index into Scene::lights
  Vec3 position{0};    // [m]
  Vec3 direction{0, 0, -1};
  Vec3 intensity{0};  // as PunctualLight
  // Of goniometric ones, as PunctualLight: not along direction, but not always perpendicular to it.
  Vec3 across{1, 0, 0};
  bool operator==(const LightEdit&) const = default;
};

struct MaterialEdit {
  uint32_t material = 0;  // index into Scene::materials
  Vec3 baseColor{1};
  float metallic = 0, roughness = 1, transmission = 0, ior = 1.5f;
  Vec3 emission{0};  // radiance [W/(m^2 sr)]
  bool operator==(const MaterialEdit&) const = default;
};

struct SceneEdit {
  std::vector<ObjectEdit> objects;
  std::vector<LightEdit> lights;
  std::vector<MaterialEdit> materials;
  std::vector<ShapeEdit> shapes;
  bool operator==(const SceneEdit&) const = default;
  bool empty() const {
    return objects.empty() && lights.empty() && materials.empty() && shapes.empty();
  }
};

// The state of a light or material now, as an edit.
LightEdit editOf(const Scene& scene, uint32_t light);
MaterialEdit editOfMaterial(const Scene& scene, uint32_t material);

// Puts `later` over `into`: each thing once, in ascending order, as its last edit has it.
void merge(SceneEdit& into, const SceneEdit& later);

// All edits so far, for somebody who comes late. settled: up to the state that the gesture under
// way began with, which decides about sample streams (gi/light/transport.h). moving: since then. At
// rest all are settled.
struct EditsSoFar {
  SceneEdit settled, moving;
  // isMoving: the gesture goes on; else all becomes settled.
  void add(const SceneEdit& edit, bool isMoving);
};

// Throws Error unless everything that `edit` names exists in `scene` and every number is in range.
void checkEdit(const Scene& scene, const SceneEdit& edit);

// The scene that was read with all edits so far. Shares images with it, and meshes that have their
// shape. `before`: an earlier state, or null: shapes that stayed are shared with it, too.
Scene edited(const Scene& asRead, const SceneEdit& all, const Scene* before = nullptr);

// By instance: true if the edit moves its node or names its shape. Tracing keeps these apart from
// the rest.
std::vector<bool> movedInstances(const Scene& scene, const SceneEdit& all);

}  // namespace ninefold
