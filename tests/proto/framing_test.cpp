#include "proto/framing.h"

#include <gtest/gtest.h>

#include <algorithm>

#include <random>

namespace ninefold {
namespace {

constexpr FrameLimit kLimit{1000, 5000};
FrameLimit limits(uint16_t type) { return type == 99 ? FrameLimit{} : kLimit; }

Frame frame(uint16_t type, size_t header, size_t payload) {
  return {type, std::string(header, 'h'), Bytes(payload, std::byte{7})};
}

Bytes wire(const Frame& f) {
  Bytes out;
  ByteWriter writer(out);
  const auto head = frameHead(f);
  writer.raw(head.data(), head.size());
  writer.raw(f.header.data(), f.header.size());
  writer.raw(f.payload.data(), f.payload.size());
  return out;
}

// Feeds `bytes` in pieces of at most `piece`, collecting the frames.
std::vector<Frame> feed(FrameParser& parser, ByteView bytes, size_t piece) {
  std::vector<Frame> frames;
  while (!bytes.empty()) {
    const auto space = parser.space();
    const size_t count = std::min({space.size(), bytes.size(), piece});
    std::copy_n(bytes.begin(), count, space.begin());
    bytes = bytes.subspan(count);
    if (auto f = parser.filled(count)) frames.push_back(std::move(*f));
  }
  return frames;
}

std::string errorOf(const Bytes& bytes) {
  FrameParser parser(limits);
  try {
    feed(parser, bytes, bytes.size());
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Framing, Bytewise) {
  FrameParser parser(limits);
  const Frame sent = frame(3, 10, 0), second = frame(4, 20, 30);
  Bytes bytes = wire(sent);
  const Bytes more = wire(second);
  bytes.insert(bytes.end(), more.begin(), more.end());
  const auto frames = feed(parser, bytes, 1);
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0], sent);
  EXPECT_EQ(frames[1], second);
  EXPECT_TRUE(parser.atBoundary());
}

TEST(Framing, AnySplitGivesTheSameFrames) {
  std::mt19937 random(1);
  std::vector<Frame> sent;
  Bytes bytes;
  for (int i = 0; i < 50; ++i) {
    sent.push_back(
        frame(static_cast<uint16_t>(i % 20), random() % 50, i == 0 ? 0 : random() % 3 * 100));
    const Bytes more = wire(sent.back());
    bytes.insert(bytes.end(), more.begin(), more.end());
  }
  for (const size_t piece : {2u, 7u, 16u, 17u, 100u, 100000u}) {
    FrameParser parser(limits);
    EXPECT_EQ(feed(parser, bytes, piece), sent) << "pieces of " << piece;
  }
}

TEST(Framing, EmptyHeaderAndPayloadMakeAFrame) {
  FrameParser parser(limits);
  const Bytes bytes = wire(frame(5, 0, 0));
  EXPECT_EQ(bytes.size(), kFrameHeadBytes);
  EXPECT_EQ(feed(parser, bytes, 100).size(), 1u);
}

TEST(Framing, DisconnectAnywhereInsideIsSeen) {
  FrameParser whole(limits);
  feed(whole, wire(frame(1, 5, 0)), 100);
  EXPECT_TRUE(whole.atBoundary());
  const Bytes bytes = wire(frame(1, 5, 0));
  for (size_t cut = 1; cut < bytes.size(); ++cut) {
    FrameParser parser(limits);
    feed(parser, ByteView(bytes).first(cut), 100);
    EXPECT_FALSE(parser.atBoundary()) << "cut after " << cut;
  }
}

TEST(Framing, WrongMagicNamesTheProblem) {
  Bytes bytes = wire(frame(1, 5, 0));
  bytes[0] = std::byte{'G'};
  EXPECT_NE(errorOf(bytes).find("magic"), std::string::npos);
}

TEST(Framing, WrongVersionNamesBoth) {
  Bytes bytes = wire(frame(1, 5, 0));
  bytes[4] = std::byte{9};
  EXPECT_NE(errorOf(bytes).find("version 9, this program in version 1"), std::string::npos);
}

TEST(Framing, FirstFrameMustBeSmall) {
  EXPECT_EQ(errorOf(wire(frame(1, 900, 0))), "");
  EXPECT_NE(errorOf(wire(frame(1, 5000, 0))), "");
  EXPECT_NE(errorOf(wire(frame(1, 10, 1))), "") << "no payload in the first frame";
}

TEST(Framing, TooLongIsRefusedFromTheHeadAlone) {
  const Frame greeting = frame(1, 1, 0);
  for (Frame big : {frame(2, 1001, 0), frame(2, 0, 5001), frame(99, 1, 0)}) {
    FrameParser parser(limits);
    feed(parser, wire(greeting), 100);
    EXPECT_THROW(feed(parser, wire(big), 16), Error);
  }
}

TEST(Framing, FourGigabytesAllocateNothing) {
  FrameParser parser(limits);
  feed(parser, wire(frame(1, 1, 0)), 100);
  auto head = frameHead(frame(2, 1, 1));
  for (size_t i = 8; i < 16; ++i) head[i] = std::byte{0xff};
  EXPECT_THROW(feed(parser, head, 100), Error);
}

TEST(Framing, SpuriousBytesBetweenFramesAreAnError) {
  FrameParser parser(limits);
  Bytes bytes = wire(frame(1, 5, 0));
  bytes.push_back(std::byte{0});
  const Bytes more = wire(frame(1, 5, 0));
  bytes.insert(bytes.end(), more.begin(), more.end());
  EXPECT_THROW(feed(parser, bytes, 1), Error);
}

TEST(Framing, TheDocumentedExampleIsRight) {
  // PROTOCOL.md's worked example: a Ping.
  const Frame ping{13, std::string("\x09\x01\0\0\0\0\0\0\0", 9), {}};
  const unsigned char expected[] = {0x4e, 0x39, 0x46, 0x4c, 0x01, 0x00, 0x0d, 0x00, 0x09,
                                    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x09, 0x01,
                                    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00};
  const Bytes bytes = wire(ping);
  ASSERT_EQ(bytes.size(), sizeof expected);
  EXPECT_EQ(std::memcmp(bytes.data(), expected, sizeof expected), 0);
}

}  // namespace
}  // namespace ninefold
