#include "common/scene/reader.h"

#include <algorithm>
#include <cctype>
#include <new>

#include "common/base/error.h"
#include "common/scene/gltf_guard.h"
#include "common/scene/gltf_scene.h"
#include "common/scene/obj_reader.h"
#include "common/scene/scene_folder.h"

namespace ninefold {
namespace {

std::string lowerExtension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

SceneDraft readDraft(const std::filesystem::path& file, const ReadOptions& options) {
  const std::string extension = lowerExtension(file);
  const bool gltf = extension == ".gltf" || extension == ".glb";
  if (!gltf && extension != ".obj")
    fail("not a scene that can be read: .gltf, .glb and .obj are known");
  const std::vector<unsigned char> bytes = readRegularFile(file, kMaxFileBytes);
  const SceneFolder folder(file);
  if (!gltf && options.clip)
    fail("an .obj file has no animation, so --clip {} names none", *options.clip);
  return gltf ? readGltf(bytes, folder, options) : readObj(bytes, folder);
}

// Names inside a scene file may hold anything; a message stays one line.
std::string oneLine(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
  return text;
}

// Its messages name the picture's file.
void addEnvironment(const EnvironmentSource& source, Scene& scene) {
  const auto map = readEnvironment(source);
  if (!map) return;
  scene.environmentMap = map;
  scene.environment = Radiance(strengthOf(source));
}

Scene readFile(const std::filesystem::path& file, const ReadOptions& options) try {
  SceneDraft draft = readDraft(file, options);
  Scene scene = finishScene(std::move(draft), options.isLitFromOutside());
  scene.name = file.stem().string();
  return scene;
} catch (const Error& e) {
  fail("{}: {}", file.string(), oneLine(e.what()));
} catch (const std::bad_alloc&) {
  fail("{}: not enough memory for this scene: simplify it", file.string());
}

}  // namespace

Scene readScene(const std::filesystem::path& file, const ReadOptions& options) {
  Scene scene = readFile(file, options);
  addEnvironment(options.environment, scene);
  return scene;
}

}  // namespace ninefold
