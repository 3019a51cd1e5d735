// Any line as a browser's message: a message within its bounds, or an Error.
#include "master/web/viewer_message.h"

#include <cmath>

#include "common/base/error.h"
#include "common/image/tone_map.h"
#include "tests/fuzz/fuzz.h"

namespace ninefold {
namespace {

void expectBounds(const ViewerMessage& message) {
  if (const auto* size = std::get_if<said::Size>(&message))
    NINEFOLD_CHECK(size->size.x >= 1 && size->size.y >= 1 && size->size.x <= 1e5f);
  if (const auto* exposure = std::get_if<said::Exposure>(&message))
    NINEFOLD_CHECK(!exposure->ev || std::abs(*exposure->ev) <= kMostExposure);
  if (const auto* view = std::get_if<said::View>(&message))
    NINEFOLD_CHECK(static_cast<size_t>(view->view) < kViewNames.size());
  const auto* event = std::get_if<said::Event>(&message);
  if (event == nullptr) return;
  NINEFOLD_CHECK(std::abs(event->event.pointer.x) <= 1e5f);
  NINEFOLD_CHECK(std::abs(event->event.pointer.y) <= 1e5f);
  NINEFOLD_CHECK(std::abs(event->event.notches) <= 100);
  NINEFOLD_CHECK(event->event.key >= 0 && event->event.key < 1024);
}

}  // namespace
}  // namespace ninefold

std::vector<std::vector<uint8_t>> ninefoldFuzzSeeds() {
  std::vector<std::vector<uint8_t>> seeds;
  for (const std::string_view line :
       {"hello 0123456789abcdef", "size 640.5 480", "key down 87 sca", "button up middle -1 2.5 -",
        "move 3 4 s", "scroll 1 1 -1.5 c", "blur", "view caustics", "exposure -2.5",
        "exposure auto", "lamp 3", "camera 2", "download exr", "shown", "ask", "give"})
    seeds.emplace_back(line.begin(), line.end());
  return seeds;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace ninefold;
  try {
    expectBounds(parseViewerMessage({reinterpret_cast<const char*>(data), size}));
  } catch (const Error&) {
  }
  return 0;
}
