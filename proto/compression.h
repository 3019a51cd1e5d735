// compression.h: zstd frames of large blobs. Decompression is streamed: memory grows as bytes
// appear and never beyond the declared size. Internal to scene_blobs.
// Errors: throw Error with one line.   Threads: reentrant.
#pragma once

#include "proto/bytes.h"

namespace ninefold {

Bytes compressBlob(ByteView raw, int level);

// Exactly `declared` bytes, or an Error: damaged data, data behind the frame, more or fewer bytes.
Bytes decompressBlob(ByteView compressed, uint64_t declared);

}  // namespace ninefold
