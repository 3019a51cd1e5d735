// photon_scene_file.cpp: apart from photon_scene.cpp, which clients use: they need no readers of
// files, nor what these need.
#include "common/scene/photon_scene.h"
#include "common/scene/reader.h"

namespace ninefold {

Scene withPhotonScene(Scene scene, const std::optional<std::string>& file) {
  if (file) addPhotonScene(scene, readScene(*file));
  return scene;
}

}  // namespace ninefold
