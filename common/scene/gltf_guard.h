// gltf_guard.h: looks over the bytes of a glTF file before the parser sees them, so that none of
// them can make it read past the end, recurse without bound or build a tree of unbounded size.
//
// Binary glTF: a 12-byte header (magic, version 2, length), then chunks, each an 8-byte head and a
// body: one JSON chunk, then at most one BIN chunk that we care for.
// Threads: pure.   Errors: throws Error.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace ninefold {

inline constexpr size_t kMaxJsonDepth = 64;
inline constexpr size_t kMaxJsonValues = 16'000'000;

bool isBinaryGltf(std::span<const unsigned char> file);

// The JSON text of a glTF file of either kind, checked.
std::string_view checkedJson(std::span<const unsigned char> file);

}  // namespace ninefold
