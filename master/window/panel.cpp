#include "master/window/panel.h"

#include <imgui.h>

#include <algorithm>

#include "common/math/units.h"
#include "common/scene/settings_table.h"
#include "master/window/overlays.h"

namespace ninefold {
namespace {

constexpr size_t kCamerasShown = 24;

const char* nameOf(ClientState state) {
  constexpr std::array kNames{"connecting", "syncing", "building", "ready", "lost"};
  return kNames[static_cast<size_t>(state)];
}

void line(const std::string& text) { ImGui::TextWrapped("%s", text.c_str()); }

template <typename T, typename Value>
void slide(bool changed, std::optional<T>& to, const Value& value) {
  if (changed) to = value;
}

void drawNumbers(const PanelView& view) {
  if (view.shown == nullptr) return line(view.state);
  const Shown& shown = *view.shown;
  const std::string step = MotionQuality::describe(shown.frame.quality);
  const float last = view.frameTimes.empty() ? 0 : view.frameTimes.back();
  line(fmt::format("{}x{}  {:.0f} ms  {}", shown.image->width, shown.image->height, double(last),
                   shown.frame.moving ? (step.empty() ? "moving" : "moving: " + step) : "resting"));
  ImGui::PlotLines("##times", view.frameTimes.data(), static_cast<int>(view.frameTimes.size()), 0,
                   nullptr, 0, 4 * view.target,
                   ImVec2(ImGui::GetContentRegionAvail().x, scaled(48)));
  line(fmt::format("{:.2f} Mrays/s   {:.0f} tasks/s", 1e-6 * view.raysPerSecond,
                   view.tasksPerSecond));
  if (!shown.frame.moving)
    line(shown.frames < 2
             ? fmt::format("{} frame", shown.frames)
             : fmt::format("{} frames   error {:.2f} %", shown.frames, 100 * shown.relativeError));
  if (const StepStats& s = view.steps; s.steps > 0)
    line(fmt::format("state: {} steps of {:.1f} ms, {:.1f} kB each", s.steps, s.ms,
                     1e-3 * static_cast<double>(s.bytesReceived) / static_cast<double>(s.steps)));
  line(fmt::format("flying {:.2f} m/s", view.speed));
  const auto stuck = std::ranges::count_if(view.clients, &ClientInfo::isStuck);
  if (stuck > 0) line(fmt::format("{} client(s) stuck: see Clients", stuck));
}

void drawClients(const PanelView& view) {
  if (!ImGui::CollapsingHeader("Clients")) return;
  for (const ClientInfo& client : view.clients) {
    std::string text =
        fmt::format("{} {}", client.name, client.isStuck() ? "stuck" : nameOf(client.status.state));
    if (client.status.state == ClientState::syncing)
      text += fmt::format(" {:.0f} %", 100 * client.status.synced);
    if (client.work)
      text += fmt::format("  {} tasks  {:.0f} % busy", client.work->tasks,
                          100 * client.work->busyFraction());
    line(text);
  }
}

// What was typed may be anything, even no number.
template <typename T>
T inRange(T value, double low, double high) {
  const T least = static_cast<T>(low), most = static_cast<T>(high);
  return value >= least ? std::min(value, most) : least;
}

// Slides within [low, high]; what is typed may be more, but not out of [least, most].
bool slider(const char* label, float& value, Vec2 reach, const char* format, double least,
            double most, ImGuiSliderFlags flags = ImGuiSliderFlags_None) {
  const bool changed = ImGui::SliderFloat(label, &value, reach.x, reach.y, format, flags);
  if (changed) value = inRange(value, least, most);
  return changed;
}

// Whether a person has changed it: one overload for each type of a row with a slider.
bool draw(const Setting<int>& row, int& value) {
  const Slider& s = row.slider;
  const bool changed = ImGui::SliderInt(s.label, &value, static_cast<int>(s.low),
                                        static_cast<int>(s.high), s.format);
  if (changed) value = inRange(value, row.low, row.high);
  return changed;
}

bool draw(const Setting<float>& row, float& value) {
  const Slider& s = row.slider;
  return slider(s.label, value, Vec2(s.low, s.high), s.format, row.low, row.high,
                s.isLogarithmic ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None);
}

bool draw(const Setting<bool>& row, bool& value) {
  return ImGui::Checkbox(row.slider.label, &value);
}

bool draw(const Setting<Interleave>& row, Interleave& value) {
  const Slider& s = row.slider;
  int side = value.n;
  const bool changed =
      ImGui::SliderInt(s.label, &side, static_cast<int>(s.low), static_cast<int>(s.high));
  side = inRange(side, row.low, row.high);
  if (changed) value = {side, side};
  return changed;
}

const char* titleOf(Method method) { return factsOf(method).title; }

template <typename Enum>
const char* titleOf(Enum value) {
  return namesOf(value)[static_cast<size_t>(value)];
}

template <typename Enum>
requires std::is_enum_v<Enum>
bool draw(const Setting<Enum>& row, Enum& value) {
  if (!ImGui::BeginCombo(row.slider.label, titleOf(value))) return false;
  const Enum before = value;
  for (size_t i = 0; i < namesOf(before).size(); ++i) {
    const auto each = static_cast<Enum>(i);
    if (ImGui::Selectable(titleOf(each), each == before)) value = each;
  }
  ImGui::EndCombo();
  return value != before;
}

// What the method has no use for is grey.
void drawLight(const PanelView& view, PanelChanges& changes) {
  if (!ImGui::CollapsingHeader("Light")) return;
  Settings s = view.settings;
  bool changed = false;
  forEachSetting([&](const auto& row) {
    if constexpr (requires { draw(row, s.*row.member); }) {
      if (row.slider.label == nullptr) return;
      ImGui::BeginDisabled(!row.isUsedBy(view.settings.method));
      changed |= draw(row, s.*row.member);
      ImGui::EndDisabled();
    }
  });
  slide(changed, changes.settings, s);
}

void drawViews(const PanelView& view, PanelChanges& changes) {
  if (!ImGui::BeginCombo("view", nameOf(view.view))) return;
  for (size_t i = 0; i < kViewNames.size(); ++i) {
    const auto each = static_cast<PictureView>(i);
    const std::string text = fmt::format("{}  [{}]", nameOf(each), keyOf(each));
    if (ImGui::Selectable(text.c_str(), each == view.view)) changes.view = each;
  }
  ImGui::EndCombo();
}

void drawLens(const Camera& camera, PanelChanges& changes) {
  float fov = camera.verticalFov * 180 / kPi, height = camera.orthographicHeight;
  if (isOrthographic(camera))
    slide(slider("picture's height", height, Vec2(0.5f, 2) * height, "%.3g m", 0, kLargestFilm),
          changes.orthographicHeight, height);
  else
    slide(slider("field of view", fov, Vec2(5, 120), "%.0f deg", 1, 179), changes.verticalFov,
          fov * kPi / 180);
}

void drawPicture(const PanelView& view, PanelChanges& changes) {
  if (!ImGui::CollapsingHeader("Picture", ImGuiTreeNodeFlags_DefaultOpen)) return;
  drawViews(view, changes);
  float exposure = view.tone.exposure, target = view.target;
  bool automatic = view.autoExposure;
  slide(slider("exposure", exposure, Vec2(-8, 8), "%.1f EV", -kMostExposure, kMostExposure),
        changes.exposure, exposure);
  slide(ImGui::Checkbox("auto exposure", &automatic), changes.autoExposure, automatic);
  auto curve = static_cast<int>(view.tone.curve);
  slide(ImGui::Combo("tone map", &curve, kToneCurveNames.data(), int{kToneCurveNames.size()}),
        changes.curve, static_cast<ToneCurve>(curve));
  slide(slider("frame in motion", target, Vec2(20, 500), "%.0f ms", 1, 10000), changes.target,
        target);
  drawLens(view.settings.camera, changes);
  for (size_t i = 0; i < view.cameras.size() && i < kCamerasShown; ++i) {
    if (i % 3 > 0) ImGui::SameLine();
    ImGui::PushID(static_cast<int>(i));  // names may be alike
    if (ImGui::SmallButton(view.cameras[i].c_str())) changes.camera = i;
    ImGui::PopID();
  }
  changes.saveView = ImGui::SmallButton("keep this view");
  if (view.playing) changes.togglePlay = ImGui::Button(*view.playing ? "pause" : "play");
  changes.savePng = ImGui::Button("PNG");
  ImGui::SameLine();
  changes.saveExr = ImGui::Button("EXR");
  ImGui::SameLine();
  changes.record = ImGui::Button(view.recording ? "stop recording" : "record");
}

void drawMaterial(const PanelView& view, PanelChanges& changes) {
  MaterialEdit m = view.material;
  bool changed = ImGui::ColorEdit3("colour", &m.baseColor.x, ImGuiColorEditFlags_Float);
  changed |= slider("roughness", m.roughness, Vec2(0, 1), "%.3f", 0, 1);
  changed |= slider("metalness", m.metallic, Vec2(0, 1), "%.3f", 0, 1);
  changed |= slider("transmission", m.transmission, Vec2(0, 1), "%.3f", 0, 1);
  changed |= slider("ior", m.ior, Vec2(1, 2.5f), "%.3f", 1, 10);
  if (!isBlack(m.emission) || view.material.material != m.material)
    changed |= ImGui::DragFloat3("emission", &m.emission.x, 0.5f, 0, 10000);
  m.baseColor = glm::clamp(m.baseColor, Vec3(0), Vec3(1));
  m.emission = glm::max(m.emission, Vec3(0));
  slide(changed, changes.material, m);
}

void drawLamp(const PanelView& view, PanelChanges& changes) {
  LightEdit l = view.light;
  bool changed = ImGui::DragFloat3("place", &l.position.x, 0.01f);
  changed |= ImGui::DragFloat3("intensity", &l.intensity.x, 0.5f, 0, 100000);
  l.intensity = glm::max(l.intensity, Vec3(0));
  slide(changed, changes.light, l);
}

void drawThing(const PanelView& view, PanelChanges& changes) {
  if (!ImGui::CollapsingHeader("Thing", ImGuiTreeNodeFlags_DefaultOpen)) return;
  for (uint32_t i = 0; i < view.lights.size() && i < 16; ++i)
    if (ImGui::SmallButton(view.lights[i].c_str())) changes.selectLight = i;
  if (!view.selection) {
    line("click on something");
  } else {
    line(view.selection->name);
    if (view.selection->light)
      drawLamp(view, changes);
    else
      drawMaterial(view, changes);
    changes.sliderReleased = !ImGui::IsAnyItemActive();
  }
  changes.undo = ImGui::Button("undo");
  ImGui::SameLine();
  changes.redo = ImGui::Button("redo");
  ImGui::SameLine();
  changes.saveScene = ImGui::Button("save scene");
}

}  // namespace

PanelChanges drawPanel(const PanelView& view) {
  PanelChanges changes;
  const float margin = scaled(kPanelMargin), width = scaled(kPanelWidth);
  ImGui::SetNextWindowPos(ImVec2(margin, margin));
  ImGui::SetNextWindowSize(ImVec2(width, 0));
  ImGui::SetNextWindowSizeConstraints(
      ImVec2(width, 0), ImVec2(width, std::max(1.0f, ImGui::GetIO().DisplaySize.y - 2 * margin)));
  ImGui::SetNextWindowCollapsed(view.folded, ImGuiCond_Once);
  ImGui::SetNextWindowBgAlpha(0.75f);
  if (ImGui::Begin("ninefold", nullptr, ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize)) {
    ImGui::PushItemWidth(scaled(130));
    drawNumbers(view);
    drawClients(view);
    if (ImGui::CollapsingHeader("Needs"))
      for (const std::string& need : view.needs) line(need);
    drawPicture(view, changes);
    drawLight(view, changes);
    drawThing(view, changes);
    ImGui::PopItemWidth();
  }
  changes.folded = ImGui::IsWindowCollapsed();
  changes.area = endDrawn();
  return changes;
}

}  // namespace ninefold
