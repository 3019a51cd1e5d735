// random_tile.h: tiles like those a renderer makes, and harder ones, from a seed.
#pragma once

#include <random>

#include "common/image/layers.h"
#include "common/math/units.h"
#include "proto/tile_codec.h"

namespace ninefold {

class TileMaker {
 public:
  explicit TileMaker(uint32_t seed) : random_(seed) {}

  // Radiance spread evenly over twelve decades, about one pixel in eight without a surface.
  TileResult make(int width, int height, uint8_t layers, uint8_t extras) {
    TileResult tile;
    tile.reset(width, height, layers, extras);
    for (int layer = 0; layer < kLayers; ++layer)
      if (hasLayer(layers, layer)) fill(tile.layers[static_cast<size_t>(layer)]);
    fill(tile.extras);
    return tile;
  }
  float uniform() { return std::uniform_real_distribution<float>(0, 1)(random_); }
  float decades(float low, float high) { return std::pow(10.0f, low + (high - low) * uniform()); }
  Vec3 direction() {
    std::normal_distribution<float> normal;
    return glm::normalize(Vec3(normal(random_), normal(random_), normal(random_)));
  }

 private:
  static void set(RgbPlane& plane, size_t i, Vec3 v) {
    plane.r[i] = v.x, plane.g[i] = v.y, plane.b[i] = v.z;
  }
  Vec3 light() { return decades(-6, 6) * Vec3(uniform(), uniform(), uniform()); }
  Vec3 fractions() { return Vec3(uniform(), uniform(), uniform()); }

  void fill(LayerPlanes& planes) {
    for (size_t i = 0; i < planes.distance.size(); ++i) {
      set(planes.unfiltered, i, light());
      if (uniform() < 0.125f) continue;
      set(planes.reflectance, i, kInvPi * fractions());
      set(planes.irradiance, i, light());
      set(planes.normal, i, direction());
      planes.distance[i] = decades(-2, 3);
      planes.chain[i] = static_cast<uint16_t>(random_());
    }
  }
  void fill(ExtraPlanes& extras) {
    for (size_t i = 0; i < extras.albedo.r.size(); ++i) set(extras.albedo, i, fractions());
    for (size_t i = 0; i < extras.normal.r.size(); ++i) set(extras.normal, i, direction());
    for (size_t i = 0; i < extras.caustic.r.size(); ++i) set(extras.caustic, i, light());
    for (size_t i = 0; i < extras.irradiance.r.size(); ++i) set(extras.irradiance, i, light());
    for (float& depth : extras.depth) depth = decades(-2, 3);
    for (uint32_t& object : extras.object) object = static_cast<uint32_t>(random_());
  }
  std::mt19937 random_;
};

// All of a tile in planes of its own.
inline TileResult decodeAll(const UnpackedTile& tile, const TileShape& shape) {
  TileResult out;
  out.reset(shape.width, shape.height, shape.layerMask, shape.extraMask);
  tile.copy({0, 0, 0, shape.width, shape.height}, shape.layerMask, shape.layerMask, shape.width,
            out);
  return out;
}
inline TileResult decodeAll(ByteView bytes, const TileShape& shape) {
  return decodeAll(TileDecoder().unpack(Bytes(bytes.begin(), bytes.end()), shape), shape);
}

}  // namespace ninefold
