#include "proto/framing.h"

#include <utility>

namespace ninefold {
namespace {

template <typename T>
void put(std::byte*& at, T value) {
  std::memcpy(at, &value, sizeof value);
  at += sizeof value;
}

template <typename T>
T get(const std::byte*& at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  at += sizeof value;
  return value;
}

}  // namespace

std::array<std::byte, kFrameHeadBytes> frameHead(const Frame& frame) {
  std::array<std::byte, kFrameHeadBytes> head;
  std::byte* at = head.data();
  put(at, kFrameMagic);
  put(at, kFrameVersion);
  put(at, frame.type);
  put(at, static_cast<uint32_t>(frame.header.size()));
  put(at, static_cast<uint32_t>(frame.payload.size()));
  return head;
}

std::span<std::byte> FrameParser::space() {
  switch (stage_) {
    case Stage::header:
      return std::as_writable_bytes(std::span(frame_.header)).subspan(have_);
    case Stage::payload:
      return std::span(frame_.payload).subspan(have_);
    default:
      return std::span(head_).subspan(have_);
  }
}

std::optional<Frame> FrameParser::filled(size_t count) {
  const size_t wanted = space().size();
  NINEFOLD_CHECK(count <= wanted);
  have_ += count;
  if (count < wanted) return std::nullopt;
  return advance();
}

std::optional<Frame> FrameParser::advance() {
  have_ = 0;
  if (stage_ == Stage::head) {
    openHead();
    stage_ = Stage::header;
    if (!frame_.header.empty()) return std::nullopt;
  }
  if (stage_ == Stage::header) {
    stage_ = Stage::payload;
    if (!frame_.payload.empty()) return std::nullopt;
  }
  stage_ = Stage::head;
  first_ = false;
  return std::exchange(frame_, {});
}

void FrameParser::openHead() {
  const std::byte* at = head_.data();
  if (get<uint32_t>(at) != kFrameMagic)
    fail("peer does not speak Ninefold's protocol (wrong magic number)");
  if (const auto version = get<uint16_t>(at); version != kFrameVersion)
    fail("peer frames its messages in version {}, this program in version {}; use one release",
         version, kFrameVersion);
  frame_.type = get<uint16_t>(at);
  const auto headerBytes = get<uint32_t>(at);
  const auto payloadBytes = get<uint32_t>(at);
  const FrameLimit limit = first_ ? kFirstFrameLimit : limits_(frame_.type);
  if (headerBytes > limit.header || payloadBytes > limit.payload)
    fail("peer announces a message of type {} with {} + {} bytes, at most {} + {} are allowed",
         frame_.type, headerBytes, payloadBytes, limit.header, limit.payload);
  frame_.header.resize(headerBytes);
  frame_.payload.resize(payloadBytes);
}

}  // namespace ninefold
