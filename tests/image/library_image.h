// library_image.h: image files in memory, as OpenImageIO writes them.
#pragma once

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace ninefold {

using Notes = std::vector<std::pair<std::string, std::string>>;  // attributes

// A ramp of 16 x 8 pixels. `extension` tells the format.
inline std::vector<uint8_t> libraryImage(const std::string& extension, int channels,
                                         OIIO::TypeDesc type, const Notes& notes = {},
                                         int tile = 0) {
  OIIO::ImageSpec spec(16, 8, channels, type);
  spec.tile_width = spec.tile_height = tile;
  for (const auto& [name, value] : notes) spec.attribute(name, value);
  std::vector<float> texels(static_cast<size_t>(16 * 8 * channels));
  for (size_t i = 0; i < texels.size(); ++i) texels[i] = static_cast<float>(i / 3 % 16) / 16;
  OIIO::Filesystem::IOVecOutput file;
  const std::string name = "a." + extension;
  const auto output = OIIO::ImageOutput::create(name, &file);
  if (!output || !output->open(name, spec) ||
      !output->write_image(OIIO::TypeDesc::FLOAT, texels.data()) || !output->close())
    throw std::runtime_error(name + ": the library cannot write it: " + OIIO::geterror());
  return file.buffer();
}

// What a camera and a program leave in a photo.
inline Notes photoNotes() {
  return {{"Make", "A camera of some length"},
          {"Exif:UserComment", std::string(100, 'x')},
          {"Keywords", "iptc; words"},
          {"ImageDescription", "what is seen"},
          {"Software", "a program"}};
}

}  // namespace ninefold
