// image_input.h: an image file in memory, checked (image_check.h) and then read by OpenImageIO.
// Alpha is never premultiplied.
//
// Owner:   an ImageInput reads `file` as long as it lives.
// Threads: reentrant; an ImageInput is of one thread.
// Errors:  throws Error that says what is wrong with the image; the caller knows which one it is.
#pragma once

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "common/image/image_formats.h"

namespace ninefold {

class ImageInput {
 public:
  ImageInput(std::string_view format, FileBytes file, ImageLimits limits);

  const OIIO::ImageSpec& spec() const { return spec_; }
  // Rows top to bottom, `channels` values for each pixel.
  void read(int channel, int channels, OIIO::TypeDesc type, void* to);

 private:
  // Gives the file's bytes and nothing else: the library's own reader does not mind positions
  // before the first byte, and damaged headers ask for them.
  class Bytes : public OIIO::Filesystem::IOMemReader {
   public:
    using IOMemReader::IOMemReader;
    size_t read(void* to, size_t bytes) override;
    size_t pread(void* to, size_t bytes, int64_t offset) override;
  };

  [[noreturn]] void failToRead() const;

  std::string format_;
  std::vector<std::byte> pixels_;
  Bytes bytes_;  // outlives the input that reads it
  std::unique_ptr<OIIO::ImageInput> input_;
  OIIO::ImageSpec spec_;
};

}  // namespace ninefold
