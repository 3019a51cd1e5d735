#include "common/scene/obj_material.h"

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/scene/file_search.h"
#include "common/scene/material_check.h"
#include "common/scene/mtl_translation.h"
#include "common/scene/text_lines.h"

namespace ninefold {
namespace {

constexpr uint64_t kMaxLibraryBytes = 64 << 20;

// A name may have a #, as in "Material #25".
std::string withoutComment(const std::string& name) { return name.substr(0, name.find(" # ")); }

}  // namespace

ObjMaterials::ObjMaterials(const SceneFolder& folder, Scene& scene)
    : folder_(&folder), scene_(&scene), textures_(folder, scene.images) {}

// False if there is no such file.
bool ObjMaterials::addLibrary(const std::string& name) {
  const auto file = findFile(*folder_, "", name);
  if (!file) return false;
  if (!libraries_.insert(*file).second) return true;
  const std::vector<unsigned char> bytes = folder_->read(*file, kMaxLibraryBytes);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::string beside = file->substr(0, file->rfind('/') + 1);
  const auto exists = [&](const std::string& map) {
    return findFile(*folder_, beside, map).has_value();
  };
  try {
    const std::vector<MtlMaterial> materials = readMtl(text, *file, exists);
    for (const MtlMaterial& m : materials) sources_.try_emplace(m.name, Source{m, beside});
    for (const MtlMaterial& m : materials)
      sources_.try_emplace(withoutComment(m.name), Source{m, beside});
  } catch (const Error& e) {
    fail("material library '{}': {}", *file, e.what());
  }
  return true;
}

void ObjMaterials::missing(std::string_view name) {
  if (libraries_.insert(std::string(name)).second)
    warn("material library '{}' is missing: its materials are grey; put it into the scene's folder",
         name);
}

// Words make a name if that is a file, or if they end in ".mtl".
void ObjMaterials::addLibraries(std::string_view line) {
  if (addLibrary(fileName(line))) return;
  std::string_view name = line.substr(0, 0);
  while (!line.empty()) {
    const std::string_view word = nextWord(line);
    if (word.empty() || word[0] == '#') break;
    const char* begin = name.empty() ? word.data() : name.data();
    name = std::string_view(begin, static_cast<size_t>(word.data() + word.size() - begin));
    const std::string file = fileName(name);
    const bool found = addLibrary(file);
    if (!found && !lowerCase(file).ends_with(".mtl")) continue;
    if (!found) missing(file);
    name = line.substr(0, 0);
  }
  if (!name.empty()) missing(name);
}

const ObjMaterials::Source* ObjMaterials::find(const std::string& name) const {
  auto found = sources_.find(name);
  if (found == sources_.end()) found = sources_.find(withoutComment(name));
  return found == sources_.end() ? nullptr : &found->second;
}

Material ObjMaterials::translated(const Source& source) try {
  Material m = translate(source.material);
  textures_.addMaps(source.material, source.beside, m);
  warnOfLostLayers(m);
  return m;
} catch (const Error& e) {
  fail("material '{}': {}", source.material.name, e.what());
}

int ObjMaterials::use(const std::string& name, bool hasColours) {
  if (const auto known = known_.find({name, hasColours}); known != known_.end())
    return known->second;
  const Source* source = find(name);
  if (source != nullptr) {
    if (const auto known = known_.find({name, !hasColours}); known != known_.end())
      return known->second;
    scene_->materials.push_back(translated(*source));
  } else {
    if (!name.empty() && !known_.contains({name, !hasColours}))
      warn("material '{}' is in no library: it is {}", name, hasColours ? "white" : "grey");
    scene_->materials.push_back(defaultGrey(name));
    if (hasColours) scene_->materials.back().baseColor = Vec3(1);
  }
  return known_[{name, hasColours}] = static_cast<int>(scene_->materials.size()) - 1;
}

}  // namespace ninefold
