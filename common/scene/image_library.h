// image_library.h: the images of a scene while it is read: decoded once each, within one budget of
// texels. An image used as colour (sRGB) and as data (linear) becomes two. Errors: throws Error,
// naming the image.   Threads: one.   Refers to the images it fills.
#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>

#include "common/scene/reader.h"

namespace ninefold {

class ImageLibrary {
 public:
  explicit ImageLibrary(std::vector<TextureImage>& images) : images_(&images) {}

  // Index of the image `name`; `bytes` is asked for its compressed bytes when it is new. Names tell
  // images apart.
  int add(const std::string& name, bool srgb,
          const std::function<std::span<const unsigned char>()>& bytes);

 private:
  int append(TextureImage image);

  std::vector<TextureImage>* images_;
  std::map<std::pair<std::string, bool>, int> known_;
  uint64_t texelsLeft_ = kMaxTexels;
};

}  // namespace ninefold
