// byte_planes.h: planes of bytes, packed before zstd sees them. Internal to the tile codec.
//
//   plane := 0            every byte is 0
//          | 1 value u8   every byte is `value`
//          | 2 byte*      the bytes as they are
//          | 3 byte*      differences to the left neighbour, modulo 256;
//                         of a row's first byte: to the one above
//
// The writer takes differences where these repeat more often than the bytes: zstd gains by that.
// Errors: openPlane throws Error on an unknown mode or missing bytes.   Threads: pure functions.
#pragma once

#include <cstdint>
#include <span>

#include "proto/bytes.h"

namespace ninefold {

// `plane`: rows of `width` bytes. `differences`: whether mode 3 may be used.
void writePlane(std::span<const uint8_t> plane, size_t width, bool differences, Bytes& out);
// What writePlane writes for a plane of zeros.
void writeZeroPlane(Bytes& out);

// A plane: bytes within those that were read (differences undone in place), or one value for all.
struct PlaneView {
  const uint8_t* bytes = nullptr;  // null: constant
  uint8_t value = 0;
};
PlaneView openPlane(MutableReader& in, size_t width, size_t size);

}  // namespace ninefold
