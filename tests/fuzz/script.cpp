// Any bytes as a script: an Error, or a script whose state is finite at every moment.
#include "master/options/script.h"

#include <cmath>

#include "common/base/error.h"
#include "common/scene/world.h"
#include "tests/fuzz/fuzz.h"

namespace ninefold {
namespace {

Scene someScene() {
  Scene scene;
  Mesh mesh;
  mesh.positions = {Vec3(-1, 0, -1), Vec3(1, 0, -1), Vec3(1, 2, 1)};
  mesh.triangles = {Triangle(0, 1, 2)};
  scene.meshes = {mesh};
  Material glass;
  glass.name = "glass";
  scene.materials = {glass};
  scene.instances = {{"ball", 0, 2}, {"ball", 0, 5}, {"table", 0, 7}};
  PunctualLight lamp;
  lamp.name = "lamp", lamp.intensity = Vec3(4);
  scene.lights = {lamp};
  Camera camera;
  camera.name = "front";
  scene.cameras = {camera};
  scene.bounds = boundsOf(scene);
  return scene;
}

void expectFinite(const ScriptState& state) {
  NINEFOLD_CHECK(isFinite(Vec3(state.camera.eye)));
  for (const ObjectEdit& object : state.edit.objects)
    for (int column = 0; column < 4; ++column)
      for (int row = 0; row < 3; ++row) NINEFOLD_CHECK(std::isfinite(object.motion[column][row]));
}

}  // namespace
}  // namespace ninefold

std::vector<std::vector<uint8_t>> ninefoldFuzzSeeds() {
  std::vector<std::vector<uint8_t>> seeds;
  for (const std::string_view text :
       {R"({"seconds": 4, "rate": 2, "frames": 8, "events": [{"at": 0, "camera": ["front"]},
            {"from": 0, "to": 4, "camera": ["front", "0,1,2:0,1,0:40"]}]})",
        R"({"seconds": 4, "events": [{"from": 1, "to": 3, "object": "ball", "by": [2, 0, 0],
            "turn": 90}, {"at": 3.5, "object": "table", "by": [0, 1, 0]}]})",
        R"({"seconds": 2, "shots": 5, "events": [{"from": 0, "to": 1, "light": "lamp",
            "intensity": [1, 2, 3]}, {"at": 1, "material": "glass", "emission": [30, 28, 24]}]})",
        R"({"seconds": 1, "events": [{"from": 0, "to": 1, "animation": [0, 4]}]})",
        R"({"seconds": 0, "events": []})"})
    seeds.emplace_back(text.begin(), text.end());
  return seeds;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace ninefold;
  static const Scene scene = someScene();
  try {
    const std::string text(reinterpret_cast<const char*>(data), size);
    const Script script = parseScript(text, "s.json", scene);
    NINEFOLD_CHECK(script.seconds >= 0 && script.seconds <= kLongestScript);
    for (const double part : {0.0, 0.3, 1.0})
      expectFinite(script.at(part * script.seconds, scene, scene.cameras.front()));
  } catch (const Error&) {
  }
  return 0;
}
