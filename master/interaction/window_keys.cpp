#include "master/interaction/window_keys.h"

#include <algorithm>

namespace ninefold {
namespace {

using Use = WindowKey::Use;
using Kind = Command::Kind;

constexpr WindowKey told(const char* keys, const char* does) { return {keys, does}; }
constexpr WindowKey fly(const char* keys, const char* does, FlyKey way) {
  return {keys, does, Use::fly, keys[0], way};
}
constexpr WindowKey axis(const char* keys, const char* does) {
  return {keys, does, Use::axis, keys[0]};
}
constexpr WindowKey command(const char* keys, const char* does, int key, Kind kind,
                            float amount = 0) {
  return {keys, does, Use::command, key, {}, kind, false, false, amount};
}
constexpr WindowKey control(const char* keys, const char* does, int key, Kind kind,
                            bool shift = false) {
  return {keys, does, Use::command, key, {}, kind, true, shift};
}

constexpr WindowKey kKeys[] = {
    fly("W", "fly forward", FlyKey::forward),
    fly("S", "fly back", FlyKey::back),
    fly("A", "fly left", FlyKey::left),
    fly("D", "fly right", FlyKey::right),
    fly("E", "fly up", FlyKey::up),
    fly("Q", "fly down", FlyKey::down),
    told("Shift", "held: fly in a hurry"),
    told("wheel", "flying speed"),
    told("Control+wheel", "towards the last click"),
    told("right button", "look around"),
    told("middle button", "orbit about the last click"),
    told("Shift+middle", "slide along the picture"),
    told("click", "select"),
    told("drag", "move what is selected"),
    told("Control+drag", "move it up and down"),
    axis("X", "held: drag along x"),
    axis("Y", "held: drag along y"),
    axis("Z", "held: drag along z"),
    axis("R", "held: a drag turns"),
    command("L", "lamp on or off", 'L', Kind::toggleLamp),
    command("F", "frame the selection", 'F', Kind::frameSelection),
    command("Escape", "select nothing", key::kEscape, Kind::deselect),
    control("Control+Shift+Z", "redo", 'Z', Kind::redo, true),
    control("Control+Z", "undo", 'Z', Kind::undo),
    control("Control+Y", "redo", 'Y', Kind::redo),
    control("Control+S", "save the scene", 'S', Kind::saveScene),
    command("P", "save the picture", 'P', Kind::savePicture),
    command("Home", "the first view again", key::kHome, Kind::reset),
    command("C", "next camera", 'C', Kind::nextCamera),
    command("V", "keep this view as a camera", 'V', Kind::saveView),
    {"digits", "what is shown (Shift: more)", Use::view},
    command("[", "darker", '[', Kind::exposure, -WindowInput::kExposureStep),
    command("]", "brighter", ']', Kind::exposure, WindowInput::kExposureStep),
    command("Space", "pause, go on", ' ', Kind::togglePlay),
    command("Tab", "panel on or off", key::kTab, Kind::togglePanel),
    command("F1", "these keys", key::kF1, Kind::toggleKeys),
    command("?", "these keys", '?', Kind::toggleKeys),
    control("Control+Q", "close the window", 'Q', Kind::close),
};

bool isDigit(int key) { return key >= '0' && key <= '9'; }

bool means(const WindowKey& row, int key, const Modifiers& held) {
  if (row.use == Use::view) return isDigit(key) && !held.control;
  return row.key == key && row.use != Use::told && row.control == held.control &&
         (held.shift || !row.shift);
}

}  // namespace

std::span<const WindowKey> windowKeys() { return kKeys; }

const WindowKey* meaningOf(int key, const Modifiers& held) {
  const auto found =
      std::ranges::find_if(kKeys, [&](const WindowKey& row) { return means(row, key, held); });
  return found == std::end(kKeys) ? nullptr : &*found;
}

}  // namespace ninefold
