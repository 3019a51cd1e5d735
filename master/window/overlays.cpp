#include "master/window/overlays.h"

#include <imgui.h>

#include <algorithm>

#include "master/interaction/window_keys.h"

namespace ninefold {
namespace {

constexpr float kFontSize = 15;  // of an ordinary screen

ImVec2 share(float x, float y) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  return {x * size.x, y * size.y};
}

}  // namespace

float scaled(float length) { return length * ImGui::GetFontSize() / kFontSize; }

void beginCentred(const char* title, float width) {
  ImGui::SetNextWindowPos(share(0.5f, 0.5f), ImGuiCond_Always, ImVec2(0.5f, 0.5f));
  ImGui::SetNextWindowSize(ImVec2(std::min(scaled(width), share(1, 1).x), 0));
  ImGui::Begin(title, nullptr, ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove);
}

WindowArea endDrawn() {
  const ImVec2 low = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  ImGui::End();
  return {Vec2(low.x, low.y), Vec2(low.x + size.x, low.y + size.y)};
}

void drawProgress(const std::string& state, double done) {
  ImGui::SetNextWindowPos(share(0.5f, 0.5f), ImGuiCond_Always, ImVec2(0.5f, 0.5f));
  ImGui::SetNextWindowSize(ImVec2(std::min(scaled(360), share(1, 1).x), 0));
  ImGui::Begin("##progress", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs);
  ImGui::TextWrapped("%s", state.c_str());
  ImGui::ProgressBar(static_cast<float>(done), ImVec2(-1, 0));
  ImGui::End();
}

void drawNotice(const std::string& text) {
  ImGui::SetNextWindowPos(share(0.5f, 1), ImGuiCond_Always, ImVec2(0.5f, 1.2f));
  const float width = std::min(ImGui::CalcTextSize(text.c_str()).x + scaled(24), share(0.96f, 1).x);
  ImGui::SetNextWindowSize(ImVec2(width, 0));
  ImGui::SetNextWindowBgAlpha(0.75f);
  ImGui::Begin("##notice", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                   ImGuiWindowFlags_NoFocusOnAppearing);
  ImGui::TextWrapped("%s", text.c_str());
  ImGui::End();
}

bool drawKeys(WindowArea& area) {
  bool open = true;
  ImGui::SetNextWindowPos(share(0.5f, 0.5f), ImGuiCond_Always, ImVec2(0.5f, 0.5f));
  ImGui::SetNextWindowSizeConstraints(ImVec2(0, 0), share(1, 1));
  ImGui::SetNextWindowFocus();
  ImGui::Begin("keys", &open,
               ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_AlwaysAutoResize |
                   ImGuiWindowFlags_NoMove | ImGuiWindowFlags_HorizontalScrollbar);
  const auto rows = windowKeys();
  const size_t half = (rows.size() + 1) / 2;
  if (ImGui::BeginTable("##keys", 4, ImGuiTableFlags_SizingFixedFit)) {
    for (size_t i = 0; i < half; ++i)
      for (const size_t row : {i, i + half}) {
        ImGui::TableNextColumn();
        if (row < rows.size()) ImGui::TextUnformatted(rows[row].keys);
        ImGui::TableNextColumn();
        if (row < rows.size()) ImGui::TextUnformatted(rows[row].does);
      }
    ImGui::EndTable();
  }
  area = endDrawn();
  return open;
}

}  // namespace ninefold
