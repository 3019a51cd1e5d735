#include "common/image/encode.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "common/base/error.h"

namespace ninefold {
namespace {

// `kind`: png, jpg.
std::vector<uint8_t> encode(const std::string& kind, const OIIO::ImageSpec& spec,
                            std::span<const uint8_t> texels) {
  NINEFOLD_CHECK(texels.size() == spec.image_pixels() * size_t(spec.nchannels));
  const std::string name = "a." + kind;
  OIIO::Filesystem::IOVecOutput file;
  const auto output = OIIO::ImageOutput::create(name, &file);
  if (!output) fail("no {} can be written: {}", kind, OIIO::geterror());
  const bool done = output->open(name, spec) &&
                    output->write_image(OIIO::TypeDesc::UINT8, texels.data()) && output->close();
  if (!done) fail("no {} can be written: {}", kind, output->geterror());
  const auto& bytes = file.buffer();
  return {bytes.begin(), bytes.end()};
}

}  // namespace

std::vector<uint8_t> encodePng(int width, int height, int channels,
                               std::span<const uint8_t> texels) {
  OIIO::ImageSpec spec(width, height, channels, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:UnassociatedAlpha", 1);  // texels are what they are
  if (channels == 2) spec.channelnames = {"Y", "A"}, spec.alpha_channel = 1;
  return encode("png", spec, texels);
}

std::vector<uint8_t> encodeJpeg(int width, int height, int quality,
                                std::span<const uint8_t> texels) {
  OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("CompressionQuality", quality);
  return encode("jpg", spec, texels);
}

}  // namespace ninefold
