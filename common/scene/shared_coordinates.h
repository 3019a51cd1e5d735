// shared_coordinates.h: how two maps of an MTL material become one image, although each may have
// -s, -o and -clamp of its own.
//
// Alike, or one absent   the image has their coordinates
// both repeat in the     each is looked up once and for all, at the nearest texels, in the square
// square 0..1            0..1 of the mesh's coordinates: -s whole, at most 16, no -clamp
// else                   the second has the coordinates of the first, with a warning
//
// Threads: value type, refers to the maps. Errors: none.
#pragma once

#include <string>

#include "common/scene/mtl_file.h"
#include "common/scene/scene.h"

namespace ninefold {

// How a map looks up an image.
TextureUse useOf(int image, const MtlMap& map);

class SharedCoordinates {
 public:
  // `names`: of the two, for the warning.
  SharedCoordinates(const MtlMaterial& material, const MtlMap& a, const MtlMap& b,
                    const char* names);

  TextureUse use(int image) const;
  // The part of the image that is made of `map`'s.
  TextureImage place(const TextureImage& image, const MtlMap& map) const;
  // What the image's name must tell of it.
  std::string nameOf(const MtlMap& map) const;

 private:
  const MtlMap* own_;
  bool square_ = false;
};

}  // namespace ninefold
