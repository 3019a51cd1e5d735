// web_state.h: what a session tells its viewers beside the picture, as a JSON object. Pure.
//
//   scene notice progress            names and lines; progress: before there is a picture
//   state clients frames moving error rays      of the run; error: null if it is not known
//   view views exposure auto playing            what is shown, and what could be
//   selection lamps cameras                     names; selection: null if there is none
//
// Text that is no UTF-8 is repaired.
// Threads: pure function.   Errors: none.   Proved: tests/web/web_state_test.cpp.
#pragma once

#include <string>

#include "master/session/panel_values.h"

namespace ninefold {

inline constexpr size_t kMostClientsTold = 64;

std::string stateText(const PanelView& view, const std::string& scene, const std::string& notice);
// While the scene is read, or no picture is there yet.
std::string progressText(const std::string& scene, const std::string& progress);

}  // namespace ninefold
