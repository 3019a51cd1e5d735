#include "common/scene/image_library.h"

#include "common/base/error.h"
#include "common/image/decode.h"

namespace ninefold {
namespace {

TextureImage decode(const std::string& name, std::span<const unsigned char> bytes,
                    uint64_t texelsLeft) try {
  DecodedImage decoded = decodeImage(std::as_bytes(bytes), {kMaxImageSide, texelsLeft});
  TextureImage image;
  image.name = name;
  image.width = decoded.width, image.height = decoded.height, image.channels = decoded.channels;
  image.texels = std::move(decoded.texels);
  return image;
} catch (const Error& e) {
  fail("{}: {}", name, e.what());
}

}  // namespace

int ImageLibrary::append(TextureImage image) {
  const uint64_t texels = static_cast<uint64_t>(image.width) * static_cast<uint64_t>(image.height);
  if (texels > texelsLeft_)
    fail("{}: all textures together have more than {} texels: scale them down", image.name,
         kMaxTexels);
  texelsLeft_ -= texels;
  images_->push_back(std::move(image));
  return static_cast<int>(images_->size()) - 1;
}

int ImageLibrary::add(const std::string& name, bool srgb,
                      const std::function<std::span<const unsigned char>()>& bytes) {
  if (const auto known = known_.find({name, srgb}); known != known_.end()) return known->second;
  const auto other = known_.find({name, !srgb});
  TextureImage image = other != known_.end() ? (*images_)[static_cast<size_t>(other->second)]
                                             : decode(name, bytes(), texelsLeft_);
  image.srgb = srgb;
  return known_[{name, srgb}] = append(std::move(image));
}

}  // namespace ninefold
