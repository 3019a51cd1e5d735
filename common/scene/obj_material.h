// obj_material.h: MTL materials in terms of ours. MTL has no physical definition: these are the
// rules.
//
//   Kd, map_Kd     base colour. A black Kd under a map counts as white: exporters write it so.
//   Ke, map_Ke     radiance; black under a map counts as white
//   illum 4 6 7 9  solid glass of index Ni (1.5 if not above 1), smooth. Tint = Tf / max Tf, white
//                  without Tf: files fill Tf with any grey, only its hue can be trusted.
//   illum 3 5      a smooth mirror of colour Ks, if Ks is brighter than Kd; else as below
//   all others     diffuse Kd under a gloss: F0 = F0(Ni) min(1, 2 Ks), because exporters write
//                  Ks 0.5 for an ordinary surface; GGX alpha = sqrt(2 / (Ns + 2))
//   d, Tr          below 1 and no glass: alpha blending
//   map_d          cuts holes (alpha mask, 0.5); by its alpha channel, else its first channel
//   norm           tangent-space normal map; bump and disp are none and are left out
//   -o -s -clamp   are followed; v grows upwards in the file, downwards here
//
// Colours are clamped to [0, 1], Ke to >= 0. Emission leaves the front face only.
// Source: Wavefront's Advanced Visualizer manual, appendix B; Walter et al. 2007 for alpha of Ns.
// Errors: throws Error (a missing or bad texture).
// Threads: one.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "common/scene/image_library.h"
#include "common/scene/scene_folder.h"

namespace ninefold {

class ObjMaterials {
 public:
  ObjMaterials(const SceneFolder& folder, Scene& scene);

  // Adds the materials of a library. `line`: what follows mtllib, one file name or several.
  // A missing library gives a warning: its materials are then the default grey.
  void addLibrary(const std::string& line);

  // Index into scene.materials; a name that no library has gives the default grey and, once, a
  // warning.
  int use(const std::string& name);

 private:
  struct Sources;  // the parsed libraries
  bool addFile(const std::string& name);

  const SceneFolder* folder_;
  Scene* scene_;
  ImageLibrary images_;
  std::shared_ptr<Sources> sources_;
  std::map<std::string, int> known_;
};

}  // namespace ninefold
