#include "common/image/image_input.h"

#include <algorithm>

#include "common/base/error.h"
#include "common/image/image_check.h"

namespace ninefold {
namespace {

void checkSpec(const OIIO::ImageSpec& spec, size_t fileBytes, ImageLimits limits) {
  const auto check = [&](int width, int height) {
    checkImageSize(static_cast<uint64_t>(width), static_cast<uint64_t>(height), fileBytes, limits);
  };
  if (spec.deep) fail("a deep image: write it flat");
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1)
    fail("an image of {} x {} x {} pixels", spec.width, spec.height, spec.depth);
  check(spec.width, spec.height);
  if (spec.tile_width > 0 && spec.tile_height > 0)
    check(spec.tile_width, spec.tile_height);  // whole tiles are read, however small the image is
  if (spec.nchannels < 1) fail("no channels");
}

// OpenImageIO's messages may have several lines.
std::string firstLine(const std::string& text) {
  if (text.empty()) return "unreadable";
  return text.substr(0, text.find('\n'));
}

}  // namespace

size_t ImageInput::Bytes::read(void* to, size_t bytes) {
  const size_t got = pread(to, bytes, m_pos);
  m_pos += static_cast<int64_t>(got);
  return got;
}

size_t ImageInput::Bytes::pread(void* to, size_t bytes, int64_t offset) {
  if (offset < 0 || static_cast<uint64_t>(offset) >= size()) return 0;
  return IOMemReader::pread(to, std::min(bytes, size() - static_cast<size_t>(offset)), offset);
}

ImageInput::ImageInput(std::string_view format, FileBytes file, ImageLimits limits)
    : format_(format),
      pixels_((checkImage(format, file, limits), pixelsOf(format, file))),
      bytes_(pixels_.empty() ? file.data() : pixels_.data(),
             pixels_.empty() ? file.size() : pixels_.size()),
      input_(OIIO::ImageInput::create(format_)) {
  if (!input_) fail("{} images cannot be read: {}", format_, firstLine(OIIO::geterror()));
  OIIO::ImageSpec config;
  config["oiio:UnassociatedAlpha"] = 1;
  config["bmp:monochrome_detect"] = 0;  // grey ones packed by runs overflow there in version 2.4
  OIIO::Filesystem::IOProxy* proxy = &bytes_;
  config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  if (!input_->open("memory." + format_, spec_, config)) failToRead();
  checkSpec(spec_, file.size(), limits);
}

void ImageInput::read(int channel, int channels, OIIO::TypeDesc type, void* to) {
  if (!input_->read_image(0, 0, channel, channel + channels, type, to)) failToRead();
}

void ImageInput::failToRead() const {
  fail("bad {} image: {}", format_, firstLine(input_->geterror()));
}

}  // namespace ninefold
