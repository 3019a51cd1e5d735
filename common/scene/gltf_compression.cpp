#include "common/scene/gltf_compression.h"

#include <nlohmann/json.hpp>

#include "common/scene/gltf_draco.h"
#include "common/scene/gltf_meshopt.h"

namespace ninefold {
namespace {

using Json = nlohmann::json;

Json* member(Json* object, const char* key) {
  if (object == nullptr || !object->is_object()) return nullptr;
  const auto found = object->find(key);
  return found == object->end() ? nullptr : &*found;
}

Json* extension(Json& object, const char* name) {
  return member(member(&object, "extensions"), name);
}

template <typename Visit>
void forEachOf(Json& object, const char* key, const Visit& visit) {
  Json* list = member(&object, key);
  if (list == nullptr || !list->is_array()) return;
  for (Json& item : *list) visit(item);
}

void fillFallback(Json& buffer) {
  for (const char* name : kMeshoptExtensions)
    if (const Json* fallback = member(extension(buffer, name), "fallback");
        fallback != nullptr && *fallback == true)
      buffer["byteLength"] = 1, buffer["uri"] = "data:,0";
}

void fillIndices(Json& primitive, Json& accessors) {
  const Json* indices = member(&primitive, "indices");
  if (extension(primitive, kDracoExtension) == nullptr || indices == nullptr ||
      !indices->is_number_unsigned())
    return;
  const auto index = indices->get<size_t>();
  if (index >= accessors.size() || !accessors[index].is_object()) return;
  if (!accessors[index].contains("bufferView")) accessors[index]["bufferView"] = 0;
}

}  // namespace

std::string completedJson(std::string_view json) {
  const auto names = [&](const char* name) { return json.find(name) != std::string_view::npos; };
  if (!names(kDracoExtension) && !names(kMeshoptExtensions[0]) && !names(kMeshoptExtensions[1]))
    return {};
  Json file = Json::parse(json, nullptr, false);
  if (!file.is_object()) return {};
  forEachOf(file, "buffers", fillFallback);
  if (Json* accessors = member(&file, "accessors"); accessors != nullptr && accessors->is_array())
    forEachOf(file, "meshes", [&](Json& mesh) {
      forEachOf(mesh, "primitives", [&](Json& primitive) { fillIndices(primitive, *accessors); });
    });
  return file.dump();
}

void decompress(tinygltf::Model& model) {
  decodeMeshopt(model);
  decodeDraco(model);
}

}  // namespace ninefold
