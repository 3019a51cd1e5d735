// obj_material.h: the material libraries of an OBJ file, and the materials it uses of them.
// What a material means: mtl_translation.h, obj_textures.h.
//
// A name is looked up as normalizedName (text_lines.h) tells it and, if no library has it, without
// a comment behind it. Of two materials of one name the first counts, as does the first of two
// libraries of a line.
// Threads: one.
// Errors: throws Error (a missing or bad texture, a library that leads outside the scene's folder).
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>

#include "common/scene/mtl_file.h"
#include "common/scene/obj_textures.h"

namespace ninefold {

class ObjMaterials {
 public:
  ObjMaterials(const SceneFolder& folder, Scene& scene);

  // Adds the materials of `line`, the words behind mtllib: one file name or several, with blanks or
  // quotes. A missing library gives a warning: its materials are then the default grey.
  void addLibraries(std::string_view line);

  // Index into scene.materials. A name that no library has gives a grey (white under vertex
  // colours) and one warning.
  int use(const std::string& name, bool hasColours);

 private:
  struct Source {
    MtlMaterial material;
    std::string beside;  // folder of its library, empty or ending in '/'
  };
  bool addLibrary(const std::string& name);
  void missing(std::string_view name);
  const Source* find(const std::string& name) const;
  Material translated(const Source& source);

  const SceneFolder* folder_;
  Scene* scene_;
  ObjTextures textures_;
  std::set<std::string> libraries_;  // that were read or found missing
  std::map<std::string, Source> sources_;
  std::map<std::pair<std::string, bool>, int> known_;
};

}  // namespace ninefold
