#include "common/scene/image_library.h"

#include "common/base/error.h"
#include "common/image/decode.h"

namespace ninefold {

TextureImage ImageLibrary::decode(const ImageSource& source) const try {
  DecodedImage decoded =
      decodeImage(std::as_bytes(source.bytes()), {kMaxImageSide, texelsLeft_, true});
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

int ImageLibrary::addMade(const std::string& name, bool srgb,
                          std::span<const ImageSource* const> parts, const Make& make) {
  const auto known = known_.find({name, srgb});
  if (known != known_.end()) return known->second;
  std::vector<TextureImage> decoded;
  for (const ImageSource* part : parts) decoded.push_back(decode(*part));
  TextureImage image = make(decoded);
  image.name = name, image.srgb = srgb;
  return known_[{name, srgb}] = append(std::move(image));
}

}  // namespace ninefold
