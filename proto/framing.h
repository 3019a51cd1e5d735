// framing.h: a pure machine that cuts a byte stream into frames. PROTOCOL.md has the grammar.
//
//   frame := magic u32 | version u16 | type u16 | header length u32 | payload length u32
//            | header | payload
//
// All numbers are little-endian. `header` is a protobuf message, `payload` raw bytes.
// Errors: FrameParser throws Error on the first byte that cannot be right: wrong magic or version,
// or a length over the limit for its type. It checks before anything is allocated. After an Error
// the connection must close.
// Threads: plain values, no clock, no socket.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "proto/bytes.h"

namespace ninefold {

inline constexpr uint32_t kFrameMagic = 0x4c46394e;  // the bytes "N9FL"
inline constexpr uint16_t kFrameVersion = 1;         // of the framing and of Hello; frozen
inline constexpr size_t kFrameHeadBytes = 4 + 2 + 2 + 4 + 4;

struct Frame {
  uint16_t type = 0;
  std::string header;
  Bytes payload;
  bool operator==(const Frame&) const = default;
};

struct FrameLimit {
  uint32_t header = 0;   // most bytes of the protobuf header
  uint32_t payload = 0;  // most bytes of the payload
};

// Limit for a frame of `type`. The peer's first frame is under kFirstFrameLimit as well.
using FrameLimits = FrameLimit (*)(uint16_t type);

// No peer needs more to introduce itself.
inline constexpr FrameLimit kFirstFrameLimit{4096 - kFrameHeadBytes, 0};

// The sixteen bytes in front of a frame's header and payload.
std::array<std::byte, kFrameHeadBytes> frameHead(const Frame& frame);

class FrameParser {
 public:
  explicit FrameParser(FrameLimits limits) : limits_(limits) {}

  // Where the next bytes of the stream belong; never empty. Write there, then say how many with
  // filled().
  std::span<std::byte> space();
  // Takes `count` bytes of space() as read. Returns the frame when that completes one.
  std::optional<Frame> filled(size_t count);

  // True between two frames: the only place where a stream may end.
  bool atBoundary() const { return stage_ == Stage::head && have_ == 0; }

 private:
  enum class Stage : uint8_t { head, header, payload };
  void openHead();
  std::optional<Frame> advance();

  const FrameLimits limits_;
  bool first_ = true;  // no frame has been completed yet
  Stage stage_ = Stage::head;
  size_t have_ = 0;  // bytes of the stage's field that are there
  std::array<std::byte, kFrameHeadBytes> head_{};
  Frame frame_;
};

}  // namespace ninefold
