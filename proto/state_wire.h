// state_wire.h: page deltas as bytes, and pages of a method's state as blobs; back, bit for bit.
//
// Deltas are the payload of Stepped and StateDelta. A blob of kind page is one delta that makes
// the page of nothing; its id is inside.
//
// Layout:  PROTOCOL.md, State.
// Limits:  kMaxRawDeltaBytes before compression. All sizes and counts are checked before memory is
//          taken; decompression stops at the declared size.
// Proved:  tests/proto/state_wire_test.cpp.
// Errors:  all throw Error with one line. Those that encode do so for a page that is there twice or
//          more than it can hold or send: what they give can always be sent and decoded.
// Threads: pure functions.
#pragma once

#include "common/state/page.h"
#include "proto/delta_layout.h"
#include "proto/messages.h"
#include "proto/scene_blobs.h"

namespace ninefold {

inline constexpr size_t kMaxRawDeltaBytes = 16 << 20;
inline constexpr size_t kMaxPageBlobBytes = kMostDeltaBytes;

// Pages go in the order of their ids, each once. A page's changes keep their order; there may be
// kPageSums of them, and they are shortest if their places ascend.
Bytes encodeDeltas(const PageDeltas& deltas);
PageDeltas decodeDeltas(ByteView encoded);
// Of the deltas as they were before compression.
Sha256 digestOfDeltas(ByteView encoded);

Blob packPage(PageId id, const Page& page);

// What makes the page of nothing. Checks size, hash and id against what was offered.
PageDelta unpackPage(const StatePage& offered, ByteView compressed);

}  // namespace ninefold
