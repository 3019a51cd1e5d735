// delta_layout.h: one page delta as bytes and back, bit for bit. Internal to state_wire.
//
// Layout:  PROTOCOL.md, State.
// Proved:  tests/proto/state_wire_test.cpp.
// Errors:  throw Error that names the page, if it has more than a page can hold or a place that is
//          none; reading checks counts before memory is taken.
// Threads: pure functions.
#pragma once

#include "common/state/page.h"
#include "proto/bytes.h"

namespace ninefold {

inline constexpr size_t kDeltaHeadBytes = 2 + 4 + 1 + 4;  // kind, index, form, count
inline constexpr size_t kChangeBytes = 2 + 8;             // place, amount
inline constexpr size_t kMostDeltaBytes = kDeltaHeadBytes + kPageSums * kChangeBytes;

// Appends to `out`.
void writeDelta(const PageDelta& delta, Bytes& out);
PageDelta readDelta(ByteReader& in);

}  // namespace ninefold
