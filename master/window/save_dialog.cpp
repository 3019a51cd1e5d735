#include "master/window/save_dialog.h"

#include <imgui.h>

#include <algorithm>

#include "common/scene/gltf_writer.h"
#include "master/window/overlays.h"

namespace ninefold {
namespace {

// What the file does not say of the scene.
const char* lossOf(const Scene& scene) {
  const bool moves = !scene.animated.empty() || !scene.shapes.empty();
  const bool isLit = scene.environmentMap != nullptr;
  if (moves && isLit) return " without its animation and its light from outside";
  return moves ? " without its animation" : isLit ? " without its light from outside" : "";
}

}  // namespace

void SaveDialog::save() {
  if (target_.file()) return write();
  const std::string name = target_.suggestion();
  name_.fill(0);
  std::copy_n(name.begin(), std::min(name.size(), name_.size() - 1), name_.begin());
  question_.clear();
  open_ = isNew_ = true;
}

void SaveDialog::choose() {
  const auto question = target_.choose(name_.data());
  question_ = question.value_or("");
  isNew_ = true;  // the keyboard goes back to the name
  if (question) return;
  open_ = false;
  write();
}

void SaveDialog::write() {
  const std::string path = *target_.file();
  try {
    const Scene scene = scene_();
    writeGltf(path, scene);
    notice_.say(fmt::format("the edited scene is in {}{}", std::filesystem::absolute(path).string(),
                            lossOf(scene)));
    written_();
  } catch (const Error& error) {
    target_.forget();
    notice_.complain(error.what());
  }
}

void SaveDialog::draw(Window& window) {
  if (!open_) return;
  beginCentred("save the scene", 440);
  ImGui::TextUnformatted("file (.glb)");
  ImGui::SetNextItemWidth(-1);
  if (std::exchange(isNew_, false)) ImGui::SetKeyboardFocusHere();
  const bool entered =
      ImGui::InputText("##name", name_.data(), name_.size(), ImGuiInputTextFlags_EnterReturnsTrue);
  if (!question_.empty()) ImGui::TextWrapped("%s", question_.c_str());
  const bool pressed = ImGui::Button("save");
  ImGui::SameLine();
  if (ImGui::Button("cancel") || ImGui::IsKeyPressed(ImGuiKey_Escape)) open_ = false;
  window.cover(endDrawn());
  if (entered || pressed) choose();
}

}  // namespace ninefold
