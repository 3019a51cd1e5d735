#include "master/web/viewer_message.h"

#include <fmt/core.h>

#include <array>
#include <charconv>
#include <cmath>

#include "common/base/error.h"
#include "common/image/tone_map.h"

namespace ninefold {
namespace {

constexpr double kFarthest = 1e5;  // of a pointer, and the largest picture on a screen
constexpr double kMostNotches = 100;
constexpr uint32_t kLastKey = 1023;
constexpr uint32_t kMostThings = 1'000'000;  // lamps, cameras

// Words with one space between them.
class Words {
 public:
  explicit Words(std::string_view line) : left_(line) {}

  bool areLeft() const { return !left_.empty(); }

  std::string_view next(const char* what) {
    const size_t end = std::min(left_.find(' '), left_.size());
    if (end == 0) fail("a message has no {}", what);
    const std::string_view word = left_.substr(0, end);
    left_.remove_prefix(std::min(end + 1, left_.size()));
    return word;
  }

  template <typename T, size_t n>
  T choice(const char* what, const std::array<std::pair<std::string_view, T>, n>& choices) {
    const std::string_view word = next(what);
    for (const auto& [name, value] : choices)
      if (word == name) return value;
    fail("a message has an unknown {}", what);
  }

  double real(const char* what, double low, double high) {
    const std::string_view word = next(what);
    double value = 0;
    const auto end = word.data() + word.size();
    const auto read = std::from_chars(word.data(), end, value);
    const bool good = read.ec == std::errc{} && read.ptr == end && value >= low && value <= high;
    if (!good) fail("a message has a bad {}", what);
    return value;
  }

  uint32_t whole(const char* what, uint32_t high) {
    const std::string_view word = next(what);
    uint32_t value = 0;
    const auto end = word.data() + word.size();
    const auto read = std::from_chars(word.data(), end, value);
    if (read.ec != std::errc{} || read.ptr != end || value > high)
      fail("a message has a bad {}", what);
    return value;
  }

  Vec2 place() {
    const double x = real("x", -kFarthest, kFarthest), y = real("y", -kFarthest, kFarthest);
    return {static_cast<float>(x), static_cast<float>(y)};
  }

  Modifiers held() {
    std::string_view word = next("word on what is held");
    if (word == "-") return {};
    const auto take = [&](char letter) {
      const bool is = word.starts_with(letter);
      word.remove_prefix(is ? 1 : 0);
      return is;
    };
    Modifiers held;
    held.shift = take('s');
    held.control = take('c');
    held.alt = take('a');
    if (!word.empty()) fail("a message has a bad word on what is held");
    return held;
  }

 private:
  std::string_view left_;
};

using Kind = WindowEvent::Kind;
using Way = std::pair<std::string_view, bool>;
constexpr std::array kWays{Way{"down", true}, Way{"up", false}};
using Named = std::pair<std::string_view, Button>;
constexpr std::array kButtons{Named{"left", Button::left}, Named{"right", Button::right},
                              Named{"middle", Button::middle}};
using FileKind = std::pair<std::string_view, said::Download::Kind>;
constexpr std::array kFiles{FileKind{"png", said::Download::Kind::png},
                            FileKind{"exr", said::Download::Kind::exr}};

ViewerMessage readKey(Words& words) {
  WindowEvent event;
  event.kind = words.choice("way of a key", kWays) ? Kind::keyDown : Kind::keyUp;
  event.key = static_cast<int>(words.whole("key", kLastKey));
  event.modifiers = words.held();
  return said::Event{event};
}

ViewerMessage readBlur() {
  WindowEvent event;
  event.kind = Kind::focusLost;
  return said::Event{event};
}

ViewerMessage readPointer(Words& words, Kind kind) {
  WindowEvent event;
  event.kind = kind;
  event.pointer = words.place();
  if (kind == Kind::scroll)
    event.notches = static_cast<float>(words.real("wheel", -kMostNotches, kMostNotches));
  event.modifiers = words.held();
  return said::Event{event};
}

ViewerMessage readButton(Words& words) {
  const bool down = words.choice("way of a button", kWays);
  const Button button = words.choice("button", kButtons);
  said::Event message = std::get<said::Event>(readPointer(words, Kind::move));
  message.event.kind = down ? Kind::buttonDown : Kind::buttonUp;
  message.event.button = button;
  return message;
}

ViewerMessage readExposure(Words& words) {
  Words ahead = words;
  if (ahead.next("exposure") == "auto") {
    words = ahead;
    return said::Exposure{};
  }
  const double most = double{kMostExposure};
  return said::Exposure{static_cast<float>(words.real("exposure", -most, most))};
}

ViewerMessage readSize(Words& words) {
  const double width = words.real("width", 1, kFarthest);
  const double height = words.real("height", 1, kFarthest);
  return said::Size{{static_cast<float>(width), static_cast<float>(height)}};
}

ViewerMessage readView(Words& words) {
  const auto view = viewNamed(std::string(words.next("view")));
  if (!view) fail("a message has an unknown view");
  return said::View{*view};
}

ViewerMessage read(Words& words) {
  const std::string_view verb = words.next("verb");
  if (verb == "move") return readPointer(words, Kind::move);
  if (verb == "shown") return said::Shown{};
  if (verb == "button") return readButton(words);
  if (verb == "scroll") return readPointer(words, Kind::scroll);
  if (verb == "key") return readKey(words);
  if (verb == "blur") return readBlur();
  if (verb == "size") return readSize(words);
  if (verb == "view") return readView(words);
  if (verb == "exposure") return readExposure(words);
  if (verb == "lamp") return said::Lamp{words.whole("lamp", kMostThings)};
  if (verb == "camera") return said::GoTo{words.whole("camera", kMostThings)};
  if (verb == "download") return said::Download{words.choice("kind of file", kFiles)};
  if (verb == "ask") return said::Ask{};
  if (verb == "give") return said::Give{};
  if (verb == "hello")
    return said::Hello{words.areLeft() ? std::string(words.next("token")) : std::string()};
  fail("a message has an unknown verb");
}

}  // namespace

ViewerMessage parseViewerMessage(std::string_view line) {
  if (line.size() > kLongestViewerMessage) fail("a message is too long");
  Words words(line);
  ViewerMessage message = read(words);
  if (words.areLeft()) fail("a message goes on after its end");
  return message;
}

}  // namespace ninefold
