// panel_values.h: what a panel beside the picture shows, and what a person changes there.
// Threads: plain values.   Errors: none.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/scene/edit.h"
#include "master/interaction/window_layout.h"
#include "master/output/stats.h"
#include "master/running/live_run.h"

namespace ninefold {

// The thing that a person has clicked.
struct Selection {
  int node = -1;
  std::string name;
  uint32_t material = 0;
  std::optional<uint32_t> light;  // a punctual one
  bool operator==(const Selection&) const = default;
};

struct PanelView {
  const Shown* shown = nullptr;   // null: nothing yet
  bool complete = false;          // it has all its frames, and shows what is to be seen now
  std::vector<float> frameTimes;  // the latest, oldest first [ms]
  double raysPerSecond = 0, tasksPerSecond = 0;
  std::string state;  // "loading the scene ...", "2 ready"
  StepStats steps;    // of the method's state
  std::vector<ClientInfo> clients;
  std::vector<std::string> needs;
  Settings settings;
  PictureView view = PictureView::beauty;
  Tone tone;
  bool autoExposure = false;
  float target = 100;  // frame time in motion [ms]
  double speed = 0;    // of flying [m/s]
  std::optional<Selection> selection;
  MaterialEdit material;  // of the selection
  LightEdit light;        // of the selection
  std::vector<std::string> lights;
  std::vector<std::string> cameras;
  bool recording = false;
  std::optional<bool> playing;  // if there is a script or an animation
  bool folded = false;          // when it is drawn first
};

struct PanelChanges {
  std::optional<Settings> settings;
  std::optional<PictureView> view;
  std::optional<float> exposure, target;  // [EV], [ms]
  std::optional<ToneCurve> curve;
  std::optional<bool> autoExposure;
  std::optional<float> verticalFov;         // [rad]
  std::optional<float> orthographicHeight;  // [m]
  std::optional<MaterialEdit> material;
  std::optional<LightEdit> light;
  std::optional<uint32_t> selectLight;
  std::optional<size_t> camera;
  bool savePng = false, saveExr = false, saveScene = false, record = false;
  bool undo = false, redo = false;
  bool saveView = false, togglePlay = false;
  bool sliderReleased = false;  // the next edit is another action
  bool folded = false;          // to its title
  WindowArea area;              // that it takes
};

}  // namespace ninefold
