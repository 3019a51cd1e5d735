// viewer_message.h: what a browser says: one message, one line of words. Pure.
//
//   hello [TOKEN]                     first; without a token it is refused as with a wrong one
//   size W H                          of the picture on its screen: the units of X and Y
//   key down|up KEY HELD              KEY: WindowEvent::key
//   button down|up NAME X Y HELD      NAME: left, right, middle; X Y: from the picture's upper left
//   move X Y HELD
//   scroll X Y NOTCHES HELD
//   blur                              the page lost the keyboard
//   view NAME   exposure EV|auto   lamp N   camera N
//   download png|exr
//   shown                             the update is on the screen: the next may come
//   ask   give                        for control; control to who asked
//
// HELD: s (Shift), c (Control), a (Alt) in this order, or - for none.
// Threads: pure functions.   Errors: Error in one line, which repeats nothing of a token.
// Proved: tests/web/viewer_message_test.cpp, tests/fuzz/viewer_message.cpp.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "master/assembly/view.h"
#include "master/interaction/window_events.h"

namespace ninefold {

namespace said {
struct Hello {
  std::string token;
};
struct Size {
  Vec2 size{1};
};
struct Event {
  WindowEvent event;  // its time is for who receives it to say
};
struct View {
  PictureView view = PictureView::beauty;
};
struct Exposure {
  std::optional<float> ev;  // [EV]; nothing: by the picture
};
struct Lamp {
  uint32_t number = 0;
};
struct GoTo {
  uint32_t camera = 0;
};
struct Download {
  enum class Kind : uint8_t { png, exr } kind = Kind::png;
};
struct Shown {};
struct Ask {};
struct Give {};
}  // namespace said

using ViewerMessage =
    std::variant<said::Hello, said::Size, said::Event, said::View, said::Exposure, said::Lamp,
                 said::GoTo, said::Download, said::Shown, said::Ask, said::Give>;

inline constexpr size_t kLongestViewerMessage = 256;  // [bytes]

ViewerMessage parseViewerMessage(std::string_view line);

}  // namespace ninefold
