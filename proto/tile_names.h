// tile_names.h: fields of tiles as bits, and their names for people.
//
//   bit 6 l + f   field f (reflectance, E, U, distance, normal, chain) of layer l (layers.h)
//   bit 18 + x    extra plane x (bits of ExtraPlane)
//   bit 24        finished radiance, or its codes
//
// Threads: pure functions.
#pragma once

#include <cstdint>
#include <string>

namespace ninefold {

inline constexpr uint32_t kAllTileFields = (1u << 25) - 1;

// From bits by place in a tile with these masks.
uint32_t fieldBits(uint32_t places, uint8_t layerMask, uint8_t extraMask);

// "E (diffuse), U (reflection)"
std::string namesOfFields(uint32_t bits);

}  // namespace ninefold
