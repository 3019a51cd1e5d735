#include "common/scene/image_library.h"

#include "common/base/error.h"
#include "common/image/decode.h"

namespace ninefold {
namespace {

const uint8_t* texelAt(const TextureImage& image, int x, int y) {
  const auto place =
      static_cast<size_t>(y) * static_cast<size_t>(image.width) + static_cast<size_t>(x);
  return &image.texels[place * static_cast<size_t>(image.channels)];
}

uint8_t opacityOf(const TextureImage& image, int x, int y) {
  const bool hasAlpha = image.channels == 2 || image.channels == 4;
  return texelAt(image, x, y)[hasAlpha ? image.channels - 1 : 0];
}

// `opacity` is looked up at the nearest texel where the sizes differ.
TextureImage combine(const TextureImage& colour, const TextureImage& opacity) {
  TextureImage image;
  image.width = colour.width, image.height = colour.height, image.channels = 4;
  image.texels.reserve(4 * static_cast<size_t>(image.width) * static_cast<size_t>(image.height));
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const uint8_t* c = texelAt(colour, x, y);
      const bool grey = colour.channels < 3;
      const auto ox = static_cast<int>(static_cast<int64_t>(x) * opacity.width / image.width);
      const auto oy = static_cast<int>(static_cast<int64_t>(y) * opacity.height / image.height);
      image.texels.insert(image.texels.end(),
                          {c[0], c[grey ? 0 : 1], c[grey ? 0 : 2], opacityOf(opacity, ox, oy)});
    }
  return image;
}

TextureImage whiteLike(const TextureImage& image) {
  TextureImage white;
  white.width = image.width, white.height = image.height, white.channels = 1;
  white.texels.assign(static_cast<size_t>(image.width) * static_cast<size_t>(image.height), 255);
  return white;
}

}  // namespace

TextureImage ImageLibrary::decode(const ImageSource& source) const try {
  DecodedImage decoded = decodeImage(std::as_bytes(source.bytes()), {kMaxImageSide, texelsLeft_});
  TextureImage image;
  image.name = source.name;
  image.width = decoded.width, image.height = decoded.height, image.channels = decoded.channels;
  image.texels = std::move(decoded.texels);
  return image;
} catch (const Error& e) {
  fail("{}: {}", source.name, e.what());
}

int ImageLibrary::append(TextureImage image) {
  const uint64_t texels = static_cast<uint64_t>(image.width) * static_cast<uint64_t>(image.height);
  if (texels > texelsLeft_)
    fail("{}: all textures together have more than {} texels: scale them down", image.name,
         kMaxTexels);
  texelsLeft_ -= texels;
  images_->push_back(std::move(image));
  return static_cast<int>(images_->size()) - 1;
}

int ImageLibrary::add(const ImageSource& source, bool srgb) {
  const auto known = known_.find({source.name, srgb});
  if (known != known_.end()) return known->second;
  const auto other = known_.find({source.name, !srgb});
  TextureImage image =
      other != known_.end() ? (*images_)[static_cast<size_t>(other->second)] : decode(source);
  image.srgb = srgb;
  return known_[{source.name, srgb}] = append(std::move(image));
}

int ImageLibrary::addCutout(const ImageSource* colour, const ImageSource& opacity) {
  const std::string name = (colour == nullptr ? "" : colour->name) + " cut by " + opacity.name;
  const auto known = known_.find({name, true});
  if (known != known_.end()) return known->second;
  const TextureImage mask = decode(opacity);
  TextureImage image = combine(colour == nullptr ? whiteLike(mask) : decode(*colour), mask);
  image.name = name, image.srgb = true;
  return known_[{name, true}] = append(std::move(image));
}

}  // namespace ninefold
