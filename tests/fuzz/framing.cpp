// Any bytes into the frame parser and the message decoder: frames, messages or an Error, nothing
// else. The first byte chooses how the rest is cut into pieces and who is taken to have sent it.
#include <algorithm>

#include "proto/messages.h"

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
