// compression.h: zstd frames of large blobs: of scenes, of states, of checkpoints.
//
// Decompression is streamed: memory grows as bytes appear, never beyond the declared size.
// Errors: throw Error with one line.   Threads: reentrant.
#pragma once

#include "proto/bytes.h"

namespace ninefold {

Bytes compressBlob(ByteView raw, int level);

// Exactly `declared` bytes. Throws Error on damaged data, on data behind the frame, and on more or
// fewer bytes.
Bytes decompressBlob(ByteView compressed, uint64_t declared);

}  // namespace ninefold
