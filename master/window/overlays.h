// overlays.h: small things drawn over the picture.
// Threads: the main thread, between Window::beginFrame and endFrame.
#pragma once

#include <string>

#include "master/interaction/window_layout.h"

namespace ninefold {

// Length in screen units of what is that long on an ordinary screen.
float scaled(float length);

// A window of ours in the middle; where it lies, once it is ended.
void beginCentred(const char* title, float width);
WindowArea endDrawn();

// A bar in the middle while there is no picture.
void drawProgress(const std::string& state, double done);

// For a few seconds at the lower edge. Takes no click.
void drawNotice(const std::string& text);

// All keys, in columns; false once a person has closed it.
bool drawKeys(WindowArea& area);

}  // namespace ninefold
