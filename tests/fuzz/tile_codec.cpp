// Any bytes into the tile decoder, for a shape that the first bytes choose: a tile of that shape
// with usable values, or an Error.
#include "proto/tile_codec.h"

#include "proto/messages.h"

namespace ninefold {
namespace {

bool usable(const std::vector<float>& values) {
  for (const float v : values)
    if (!(v >= 0) || !std::isfinite(v)) return false;
  return true;
}

bool usable(const RgbPlane& p) { return usable(p.r) && usable(p.g) && usable(p.b); }

void check(const TileResult& tile) {
  for (const LayerPlanes& layer : tile.layers)
    NINEFOLD_CHECK(usable(layer.reflectance) && usable(layer.irradiance) &&
                   usable(layer.unfiltered) && usable(layer.distance));
  NINEFOLD_CHECK(usable(tile.extras.albedo) && usable(tile.extras.caustic) &&
                 usable(tile.extras.depth));
}

}  // namespace
}  // namespace ninefold

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace ninefold;
  if (size < 4) return 0;
  TileShape shape{1 + data[0] % 32, 1 + data[1] % 32,
                  static_cast<uint8_t>(kDiffuseBit | data[2] % 8),
                  static_cast<uint8_t>(data[3] & kAllExtraPlanes)};
  if (data[0] == 255) shape.width = shape.height = 0;
  TileResult tile;
  try {
    TileDecoder().decode(std::as_bytes(std::span(data + 4, size - 4)), shape, tile);
  } catch (const Error&) {
    return 0;
  }
  check(tile);
  // A decoded tile is an ordinary tile: it can be sent on, and loses nothing but its dither.
  const auto again = TileEncoder().encode(tile, 1, 1);
  NINEFOLD_CHECK(again.replaced == 0);
  TileDecoder().decode(again.bytes, shape, tile);
  return 0;
}
