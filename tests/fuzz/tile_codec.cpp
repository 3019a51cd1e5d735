// Any bytes into the tile decoder, for a shape that the first bytes choose: a tile of that shape
// with usable values, or an Error.
#include "proto/tile_codec.h"

#include "proto/messages.h"
#include "tests/fuzz/fuzz.h"
#include "tests/proto/random_tile.h"

namespace ninefold {
namespace {

bool usable(const std::vector<float>& values) {
  for (const float v : values)
    if (!(v >= 0) || !std::isfinite(v)) return false;
  return true;
}

bool usable(const RgbPlane& p) { return usable(p.r) && usable(p.g) && usable(p.b); }

void checkTile(const TileResult& tile) {
  for (const LayerPlanes& layer : tile.layers)
    NINEFOLD_CHECK(usable(layer.reflectance) && usable(layer.irradiance) &&
                   usable(layer.unfiltered) && usable(layer.distance));
  NINEFOLD_CHECK(usable(tile.extras.albedo) && usable(tile.extras.caustic) &&
                 usable(tile.extras.depth));
}

void tryFinished(ByteView bytes, const TileShape& shape) {
  try {
    const UnpackedTile tile = TileDecoder().unpack(Bytes(bytes.begin(), bytes.end()), shape);
    if (tile.width() == 0) return;
    if (shape.layerMask == kDisplayMask) {
      std::vector<uint8_t> rgb(3 * static_cast<size_t>(tile.width() * tile.height()));
      return tile.copyDisplay(static_cast<size_t>(tile.width()), rgb.data());
    }
    RgbImage radiance;
    tile.copyRadiance(radiance);
    NINEFOLD_CHECK(usable(radiance.pixels));
  } catch (const Error&) {
  }
}

}  // namespace
}  // namespace ninefold

std::vector<std::vector<uint8_t>> ninefoldFuzzSeeds() {
  using namespace ninefold;
  std::vector<std::vector<uint8_t>> seeds;
  for (const uint8_t layers : {uint8_t{1}, uint8_t{3}, uint8_t{7}})
    for (const int level : {0, 1}) {
      const auto extras = static_cast<uint8_t>(layers == 7 ? kAllExtraPlanes : 0);
      const TileResult tile = TileMaker(layers).make(6, 4, layers, extras);
      auto& seed = seeds.emplace_back(std::vector<uint8_t>{5, 3, layers, extras});
      for (const std::byte b : TileEncoder().encode(tile, 1, level).bytes)
        seed.push_back(static_cast<uint8_t>(b));
    }
  RgbImage image;
  image.reset(6, 4);
  image.pixels.g.assign(24, 0.5f), image.pixels.r[5] = 3;
  const Bytes finished[] = {TileEncoder().encode(image, 1, 1).bytes,
                            TileEncoder().encode(image, ToneMap(), 1).bytes};
  for (const uint8_t kind : {uint8_t{8}, uint8_t{9}}) {
    auto& seed = seeds.emplace_back(std::vector<uint8_t>{5, 3, kind, 0});
    for (const std::byte b : finished[kind - 8]) seed.push_back(static_cast<uint8_t>(b));
  }
  return seeds;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace ninefold;
  if (size < 4) return 0;
  TileShape shape{1 + data[0] % 32, 1 + data[1] % 32,
                  static_cast<uint8_t>(kDiffuseBit | data[2] % 8),
                  static_cast<uint8_t>(data[3] & kAllExtraPlanes)};
  if (data[0] == 255) shape.width = shape.height = 0;
  if ((data[2] & 8) != 0) {  // finished pixels
    shape.layerMask = (data[2] & 1) != 0 ? kDisplayMask : kRadianceMask, shape.extraMask = 0;
    return tryFinished(std::as_bytes(std::span(data + 4, size - 4)), shape), 0;
  }
  TileResult tile;
  try {
    tile = decodeAll(std::as_bytes(std::span(data + 4, size - 4)), shape);
  } catch (const Error&) {
    return 0;
  }
  checkTile(tile);
  // A decoded tile is an ordinary tile: it can be sent on, and loses nothing but its dither.
  const auto again = TileEncoder().encode(tile, 1, 1);
  NINEFOLD_CHECK(again.replaced.count == 0);
  decodeAll(again.bytes, shape);
  return 0;
}
