// Any bytes into the frame parser and the message decoder: frames, messages or an Error, nothing
// else. The first byte chooses how the rest is cut into pieces and who is taken to have sent it.
#include <algorithm>

#include "proto/messages.h"
#include "tests/fuzz/fuzz.h"

namespace ninefold {
namespace {

void feed(ByteView bytes, size_t piece, Peer sender) {
  FrameParser parser(messageLimit);
  while (!bytes.empty()) {
    const auto space = parser.space();
    const size_t count = std::min({space.size(), bytes.size(), piece});
    std::copy_n(bytes.begin(), count, space.begin());
    bytes = bytes.subspan(count);
    auto frame = parser.filled(count);
    if (!frame) continue;
    // What was understood can be said again and means the same.
    const Frame again = encodeMessage(decodeMessage(std::move(*frame), sender));
    NINEFOLD_CHECK(encodeMessage(decodeMessage(Frame(again), sender)) == again);
  }
}

}  // namespace
}  // namespace ninefold

std::vector<std::vector<uint8_t>> ninefoldFuzzSeeds() {
  using namespace ninefold;
  const auto stream = [](uint8_t choices, std::vector<Message> messages) {
    std::vector<uint8_t> bytes{choices};
    for (Message& message : messages) {
      const Frame frame = encodeMessage(std::move(message));
      for (const std::byte b : frameHead(frame)) bytes.push_back(static_cast<uint8_t>(b));
      for (const char c : frame.header) bytes.push_back(static_cast<uint8_t>(c));
      for (const std::byte b : frame.payload) bytes.push_back(static_cast<uint8_t>(b));
    }
    return bytes;
  };
  const msg::Result result{1, 2, 3, 4, 5, 1, 0, 0, {6, 7, 8, 9}, Bytes(40)};
  const msg::Tasks tasks{1, {2, 3, 4, 0.5f}, {{1, 2, 3}, {4, 5, 6}}};
  const msg::SceneOffer offer{1, {{{}, 10, BlobKind::image}, {{}, 20, BlobKind::rest}}};
  const msg::Steps steps{1, {2, 3, 4, 5, 6}, {5, 7}};
  const msg::StateOffer pages{1, 2, {{{3, 4}, {{}, 50, BlobKind::page}}}};
  return {stream(2, {msg::Hello{}, msg::Stepped{1, 2, 3, 4, 5, {6, 7, 8, 9}, Bytes(40)}}),
          stream(0, {msg::Welcome{}, pages, steps, msg::CancelSteps{2}}),
          stream(5, {msg::StateDelta{1, 2, 0, 3, 4, 1, Bytes(40)}, tasks, steps}),
          stream(2, {msg::Hello{}, msg::BlobRequest{}, msg::Progress{}, msg::Ready{1, 1}, result}),
          stream(7, {msg::Hello{}, result, msg::Pong{1, 2}, msg::Goodbye{"done"}}),
          stream(0, {msg::Welcome{}, offer, msg::BlobChunk{{}, 5, 9, Bytes(4)},
                     msg::Configure{1, 1, {}}}),
          stream(5, {msg::Ping{}, tasks, msg::Cancel{1, 2}, msg::Refuse{"no"}})};
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace ninefold;
  if (size == 0) return 0;
  const size_t piece = data[0] % 2 == 0 ? size : 1 + data[0] / 4u;
  try {
    feed(std::as_bytes(std::span(data + 1, size - 1)), piece,
         (data[0] & 2) != 0 ? Peer::client : Peer::master);
  } catch (const Error&) {
  }
  return 0;
}
