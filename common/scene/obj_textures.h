// obj_textures.h: the maps of an MTL material as textures of the scene.
//
//   map_Kd map_Ks map_Ke  colours (sRGB), times Kd, Ks, Ke; alpha is not looked at
//   map_d                 coverage: d times its alpha channel if that says anything, else its
//                         luminance; what it half covers is half there (alpha blending)
//   map_Pr map_Pm         roughness and metallic, each a scalar, times Pr and Pm
//   norm                  tangent-space normal map; -bm scales its slopes
//   bump                  heights, or a normal map, which is what Blender writes so: the texels
//                         tell which; left out beside norm
//   -o -s -clamp -mm -bm -imfchan  are followed; -clamp repeats the edge. v grows upwards in the
//                         file, downwards here. Two maps that become one image:
//                         shared_coordinates.h. Names of files: file_search.h.
//
// Owner: refers to the folder and the images it fills.   Threads: one.
// Errors: throws Error (a missing or bad texture).
#pragma once

#include <string>

#include "common/scene/image_library.h"
#include "common/scene/mtl_file.h"
#include "common/scene/scene_folder.h"
#include "common/scene/texel_maps.h"

namespace ninefold {

class ObjTextures {
 public:
  ObjTextures(const SceneFolder& folder, SharedList<TextureImage>& images)
      : folder_(&folder), images_(images) {}

  // Adds the maps of `from` to its translation `m`. `beside`: the folder of its library.
  void addMaps(const MtlMaterial& from, const std::string& beside, Material& m);

 private:
  void addColour(const MtlMaterial& from, Material& m);
  void addEmission(const MtlMap& map, Material& m);
  void addSpecular(const MtlMap& map, Material& m);
  void addMetallicRoughness(const MtlMaterial& from, Material& m);
  void addNormals(const MtlMaterial& from, Material& m);
  int colours(const MtlMap& map, Gain gain);

  const SceneFolder* folder_;
  ImageLibrary images_;
  std::string beside_;  // of the material at hand
};

}  // namespace ninefold
