// panel.h: what lies beside the picture: numbers, sliders, clients, the selected thing. It folds to
// its title. Drawn anew for each frame of the window from values, and gives values back; it decides
// nothing.
// Threads: the main thread, between Window::beginFrame and endFrame.
#pragma once

#include "master/session/panel_values.h"

namespace ninefold {

PanelChanges drawPanel(const PanelView& view);

}  // namespace ninefold
