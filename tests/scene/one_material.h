// one_material.h: the simple scene with a material to vary, and what it needs.
#pragma once

#include "common/scene/needs.h"
#include "tests/scene/simple_scene.h"

namespace ninefold {

inline Scene withMaterial(const Material& material) {
  Scene scene = simpleScene();
  scene.materials[0] = material;
  return scene;
}

inline Needs needsWith(const Material& material) {
  return needsOf(withMaterial(material), Radiance(0));
}

// No metal; all else as by default.
inline Material matte() {
  Material m;
  m.metallic = 0;
  return m;
}

}  // namespace ninefold
