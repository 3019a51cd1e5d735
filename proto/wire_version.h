// wire_version.h: the number of the language that master and clients speak, and how its change is
// noticed.
//
// A cluster is one release, so another number always means another release. The number tells people
// which of two is older. tests/proto/wire_version_test.cpp compares what is spoken with the digests
// here, each the beginning of a SHA-256:
//   messages   the text of messages.proto without comments and spaces, and the settings' names
//   tiles      stored tiles of all layers and planes, of radiance and of a display's codes
//   scenes     the raw blobs of a scene with one of everything
//   states     deltas and pages of both forms, before compression
#pragma once

#include <cstdint>
#include <string_view>

namespace ninefold {

// Raised whenever the meaning of any message, or the format of tiles, scenes or states changes.
inline constexpr uint32_t kProtocol = 5;

inline constexpr std::string_view kMessagesDigest = "a35ce14510ecbe8c";
inline constexpr std::string_view kTilesDigest = "f68248e6f12de356";
inline constexpr std::string_view kScenesDigest = "dfface100b1a81b6";
inline constexpr std::string_view kStatesDigest = "bc7f3e420652a9f2";

}  // namespace ninefold
