// byte_planes.h: planes of bytes, packed before zstd sees them. Internal to the tile codec.
//
//   plane := 0                     every byte is 0
//          | 1 value u8            every byte is `value`
//          | 2 byte*               as they are
//          | 3 byte*               differences to the left neighbour, modulo 256 (first of a row:
//          to the one above)
//
// The writer takes differences where they repeat more often, which is where zstd gains.
// Errors: readPlane throws Error on an unknown mode or missing bytes. Threads: pure functions.
#pragma once

#include <cstdint>
#include <span>

#include "proto/bytes.h"

namespace ninefold {

// `plane` is `width` bytes times any number of rows.
void writePlane(std::span<const uint8_t> plane, size_t width, Bytes& out);
// What writePlane writes for a plane of zeros.
void writeZeroPlane(Bytes& out);

void readPlane(ByteReader& in, size_t width, std::span<uint8_t> plane);

}  // namespace ninefold
