// tile_hash.h: a name for what is in an encoded tile, whatever the level it was compressed with.
// Threads: pure functions. Errors: Error, if the bytes are not one tile of this shape.
#pragma once

#include <span>
#include <string>

#include "common/sampling/whole_tile.h"
#include "proto/messages.h"
#include "proto/tile_codec.h"

namespace ninefold {

// Of a task's tile; without pixels if there is no such task.
inline TileShape shapeOf(const TileGrid& grid, const msg::TaskItem& item, Delivery::Form form,
                         uint8_t layerMask) {
  const int tile = static_cast<int>(item.tile);
  const bool isWhole = form != Delivery::Form::layers;
  const TaskRect rect =
      isWhole ? pixelsOf(grid, tile) : grid.rect(tile, static_cast<int>(item.phase));
  if (!isWhole) return {rect.width, rect.height, layerMask, item.extraMask};
  const bool isCodes = form == Delivery::Form::display;
  return {rect.width, rect.height, isCodes ? kDisplayMask : kRadianceMask, 0};
}

class TileHash {
 public:
  // The first 16 digits of the SHA-256 of all decoded planes.
  static std::string of(const Bytes& encoded, const TileShape& shape) {
    const UnpackedTile tile = TileDecoder().unpack(Bytes(encoded), shape);
    TileHash hash;
    if (shape.layerMask == kDisplayMask)
      hash.addCodes(tile);
    else if (shape.layerMask == kRadianceMask)
      hash.addRadiance(tile);
    else
      hash.addPlanes(tile, shape);
    return hex(sha256(hash.bytes_)).substr(0, 16);
  }

 private:
  template <typename T>
  void add(const std::vector<T>& values) {
    const auto bytes = std::as_bytes(std::span(values));
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  void add(const RgbPlane& plane) { add(plane.r), add(plane.g), add(plane.b); }

  void addCodes(const UnpackedTile& tile) {
    const auto width = static_cast<size_t>(tile.width()),
               height = static_cast<size_t>(tile.height());
    std::vector<uint8_t> codes(3 * width * height);
    tile.copyDisplay(width, codes.data());
    add(codes);
  }
  void addRadiance(const UnpackedTile& tile) {
    RgbImage radiance;
    tile.copyRadiance(radiance);
    add(radiance.pixels);
  }
  void addPlanes(const UnpackedTile& tile, const TileShape& shape) {
    TileResult all;
    all.reset(shape.width, shape.height, shape.layerMask, shape.extraMask);
    tile.copy({0, 0, 0, shape.width, shape.height}, shape.layerMask, shape.layerMask, shape.width,
              all);
    for (const LayerPlanes& layer : all.layers) {
      add(layer.reflectance), add(layer.irradiance), add(layer.unfiltered), add(layer.normal);
      add(layer.distance), add(layer.chain);
    }
    add(all.extras.albedo), add(all.extras.normal), add(all.extras.caustic);
    add(all.extras.irradiance), add(all.extras.depth), add(all.extras.object);
  }

  Bytes bytes_;
};

}  // namespace ninefold
