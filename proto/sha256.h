// sha256.h: SHA-256 as the name of content.
// Threads: reentrant.   Errors: none.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "proto/bytes.h"

namespace ninefold {

using Sha256 = std::array<uint8_t, 32>;

Sha256 sha256(ByteView bytes);

// 64 lower-case hex digits.
std::string hex(const Sha256& hash);

}  // namespace ninefold
