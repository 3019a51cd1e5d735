#include "common/image/encode.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "common/base/error.h"

namespace ninefold {

std::vector<uint8_t> encodePng(int width, int height, int channels,
                               std::span<const uint8_t> texels) {
  NINEFOLD_CHECK(texels.size() == size_t(width) * size_t(height) * size_t(channels));
  OIIO::Filesystem::IOVecOutput file;
  const auto png = OIIO::ImageOutput::create("a.png", &file);
  if (!png) fail("no PNG can be written: {}", OIIO::geterror());
  OIIO::ImageSpec spec(width, height, channels, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:UnassociatedAlpha", 1);  // texels are what they are
  if (channels == 2) spec.channelnames = {"Y", "A"}, spec.alpha_channel = 1;
  const bool done = png->open("a.png", spec) &&
                    png->write_image(OIIO::TypeDesc::UINT8, texels.data()) && png->close();
  if (!done) fail("no PNG can be written: {}", png->geterror());
  const auto& bytes = file.buffer();
  return {bytes.begin(), bytes.end()};
}

}  // namespace ninefold
