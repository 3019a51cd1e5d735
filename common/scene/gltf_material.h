// gltf_material.h: glTF materials and their textures, read when the first mesh that is used asks
// for one.
// Owner: refers to file and scene.   Threads: one.   Errors: throws Error, naming the material.
#pragma once

#include <map>
#include <set>

#include "common/scene/gltf_file.h"
#include "common/scene/image_library.h"

namespace tinygltf {
class Model;
class Value;
struct Material;
}  // namespace tinygltf

namespace ninefold {

class GltfMaterials {
 public:
  GltfMaterials(const GltfFile& file, Scene& scene)
      : model_(file.model.get()),
        badImages_(&file.badImages),
        scene_(&scene),
        images_(scene.images) {}

  // Index into scene.materials of the file's material; -1 asks for glTF's default one.
  int use(int material);

 private:
  Material read(int index);
  void readCore(const tinygltf::Material& from, Material& m);
  void readExtensions(const tinygltf::Material& from, Material& m);
  void readLayers(const tinygltf::Material& from, Material& m);
  template <typename Info>
  TextureUse texture(const Info& info, bool srgb);
  TextureUse texture(const tinygltf::Value& extension, const char* key, bool srgb);
  TextureUse makeUse(int texture, int uvSet, const tinygltf::Value* transform, bool srgb);
  void readSampler(int texture, TextureUse& use) const;
  int image(int texture, bool srgb);

  const tinygltf::Model* model_;
  const std::map<int, std::string>* badImages_;
  Scene* scene_;
  ImageLibrary images_;
  std::map<int, int> known_;
};

}  // namespace ninefold
