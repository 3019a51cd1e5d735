// window_layout.h: where picture and panel lie in the window, and how large it opens. Pure.
//
// All lengths are in screen units, from the upper left corner, y downwards.
// Threads: pure functions.   Errors: none.   Proved: tests/master/window_layout_test.cpp.
#pragma once

#include "common/math/vec.h"
#include "master/interaction/window_memory.h"

namespace ninefold {

struct WindowArea {
  Vec2 low{0}, high{0};
  // As shares of its width and height.
  Vec2 share(Vec2 p) const { return (p - low) / (high - low); }
  bool contains(Vec2 p) const {
    return p.x >= low.x && p.x < high.x && p.y >= low.y && p.y < high.y;
  }
};

struct WindowSize {
  int width = 0, height = 0;
  bool operator==(const WindowSize&) const = default;
};

// What a window may take of the screen. 0 x 0: unknown.
struct ScreenSpace {
  int width = 0, height = 0;
  float scale = 1;  // screen units of what is a pixel on an ordinary screen
};

inline constexpr float kPanelWidth = 290, kPanelMargin = 8;  // on an ordinary screen

// The column that an open panel takes.
inline float panelColumn(float scale) { return scale * (kPanelWidth + 2 * kPanelMargin); }

// The remembered size; else a panel beside a picture of its own size, at least kLeastHeight high. A
// screen that is too small for both has the picture smaller.
inline constexpr int kLeastHeight = 480;
WindowSize firstSize(int pictureWidth, int pictureHeight, const WindowMemory& memory,
                     const ScreenSpace& screen);

// As large as fits right of the column, in the middle; where that would leave less than half of the
// window, as large as fits into the window. An empty picture takes all.
WindowArea areaOfPicture(WindowSize window, float column, WindowSize picture);

}  // namespace ninefold
