// image_library.h: the images of a scene while it is read: decoded once each, within one budget of
// texels. An image used as colour (sRGB) and as data (linear) becomes two.
// Owner: refers to the images it fills.   Threads: one.   Errors: throws Error, naming the image.
#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>

#include "common/scene/reader.h"

namespace ninefold {

// A compressed image: its name tells it from others; its bytes are asked for only when it is new.
struct ImageSource {
  std::string name;
  std::function<std::span<const unsigned char>()> bytes;
};

class ImageLibrary {
 public:
  explicit ImageLibrary(SharedList<TextureImage>& images) : images_(&images) {}

  int add(const ImageSource& source, bool srgb);

  // An image made of others. `make` gets those as they are in their files. `name` tells the image
  // from others that are made of the same parts.
  using Make = std::function<TextureImage(std::span<const TextureImage> parts)>;
  int addMade(const std::string& name, bool srgb, std::span<const ImageSource* const> parts,
              const Make& make);

 private:
  TextureImage decode(const ImageSource& source) const;
  int append(TextureImage image);

  SharedList<TextureImage>* images_;
  std::map<std::pair<std::string, bool>, int> known_;
  uint64_t texelsLeft_ = kMaxTexels;
};

}  // namespace ninefold
