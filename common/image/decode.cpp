#include "common/image/decode.h"

#include <algorithm>
#include <array>

#include "common/image/image_check.h"
#include "common/image/image_input.h"
#include "common/image/tone_map.h"

namespace ninefold {
namespace {

// Indices of R, G and B in the file.
std::array<int, 3> colourChannels(const OIIO::ImageSpec& spec) {
  const auto find = [&](const char* name) {
    const auto at = std::find(spec.channelnames.begin(), spec.channelnames.end(), name);
    return at == spec.channelnames.end() ? -1 : static_cast<int>(at - spec.channelnames.begin());
  };
  const std::array<int, 3> named = {find("R"), find("G"), find("B")};
  if (std::all_of(named.begin(), named.end(), [](int c) { return c >= 0; })) return named;
  return spec.nchannels >= 3 ? std::array<int, 3>{0, 1, 2} : std::array<int, 3>{0, 0, 0};
}

}  // namespace

DecodedImage decodeImage(std::span<const std::byte> file, ImageLimits limits) {
  ImageInput input(plainFormat(file), file, limits);
  DecodedImage image;
  image.width = input.spec().width, image.height = input.spec().height;
  image.channels = std::min(input.spec().nchannels, 4);
  image.texels.resize(static_cast<size_t>(image.width) * static_cast<size_t>(image.height) *
                      static_cast<size_t>(image.channels));
  input.read(0, image.channels, OIIO::TypeDesc::UINT8, image.texels.data());
  return image;
}

RgbImage decodePicture(std::span<const std::byte> file, ImageLimits limits) {
  ImageInput input(pictureFormat(file), file, limits);
  const bool isSrgb = !input.spec().format.is_floating_point();
  const std::array<int, 3> channels = colourChannels(input.spec());
  RgbImage image;
  image.reset(input.spec().width, input.spec().height);
  std::vector<float>* planes[3] = {&image.pixels.r, &image.pixels.g, &image.pixels.b};
  for (size_t c = 0; c < 3; ++c) {
    input.read(channels[c], 1, OIIO::TypeDesc::FLOAT, planes[c]->data());
    if (isSrgb)
      for (float& value : *planes[c]) value = linearFromSrgb(value);
  }
  return image;
}

}  // namespace ninefold
