// byte_planes.h: planes of bytes, packed before zstd sees them. Internal to the tile codec.
//
//   plane := 0                     every byte is 0
//          | 1 value u8            every byte is `value`
//          | 2 byte*               as they are
//          | 3 byte*               differences to the left neighbour, modulo 256 (first of a row:
//          to the one above)
//
// The writer takes differences where they repeat more often, which is where zstd gains.
// Errors: openPlane throws Error on an unknown mode or missing bytes. Threads: pure functions.
#pragma once

#include <cstdint>
#include <span>

#include "proto/bytes.h"

namespace ninefold {

// `plane` is `width` bytes times any number of rows. Differences only if they are allowed.
void writePlane(std::span<const uint8_t> plane, size_t width, bool differences, Bytes& out);
// What writePlane writes for a plane of zeros.
void writeZeroPlane(Bytes& out);

// A plane where it lies: in the bytes that were read, with differences undone in place; or all its
// bytes are `value`.
struct PlaneView {
  const uint8_t* bytes = nullptr;  // null: constant
  uint8_t value = 0;
};
PlaneView openPlane(MutableReader& in, size_t width, size_t size);

}  // namespace ninefold
