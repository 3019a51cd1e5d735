// shared_coordinates.h: how two maps of an MTL material become one image, although each may have
// -s, -o and -clamp of its own.
//
//   alike, or one absent   the image has their coordinates
//   both repeat in the     each is looked up once and for all, at the nearest texels, in the square
//   square 0..1            0..1 of the mesh's coordinates: -s whole, at most 16, no -clamp
//   else                   the second has the coordinates of the first, with a warning
//
// Owner: refers to the maps.   Threads: value type.   Errors: none.
#pragma once

#include <string>

#include "common/scene/mtl_file.h"
#include "common/scene/scene.h"

namespace ninefold {

// How a map looks up an image.
TextureUse useOf(int image, const MtlMap& map);

class SharedCoordinates {
 public:
  // `names`: of the two maps, for the warning.
  SharedCoordinates(const MtlMaterial& material, const MtlMap& a, const MtlMap& b,
                    const char* names);

  TextureUse use(int image) const;
  // `image`, which is `map`'s, as its part of the shared image.
  TextureImage place(const TextureImage& image, const MtlMap& map) const;
  // What the shared image's name must tell of `map`.
  std::string nameOf(const MtlMap& map) const;

 private:
  const MtlMap* own_;
  bool square_ = false;
};

}  // namespace ninefold
