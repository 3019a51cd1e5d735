#include "master/session/editor.h"

#include "common/base/log.h"
#include "master/session/picking.h"

namespace ninefold {
namespace {

Vec2 filmPosition(Vec2 place, int width, int height) {
  return place * Vec2(static_cast<float>(width), static_cast<float>(height));
}

Vec2 filmPosition(Vec2 place, const LiveImage& image) {
  return filmPosition(place, image.width, image.height);
}

}  // namespace

void Editor::pick(Vec2 place, const Shown& shown) {
  pick_ = place;
  live_.wantPicks(true);
  look(shown);
}

void Editor::look(const Shown& shown) {
  if (!pick_ || shown.image->picks == nullptr) return;
  const Vec2 film = filmPosition(*pick_, *shown.image);
  pick_.reset();
  const std::optional<uint32_t> instance = instanceAt(shown, film);
  if (!instance) return deselect();
  select(*instance);
  if (const auto point = pointAt(shown, film)) camera_.setPivot(*point);
}

void Editor::select(uint32_t instance) {
  const Instance& thing = scene_->instances[instance];
  const Mesh& mesh = scene_->meshes[static_cast<size_t>(thing.mesh)];
  selection_ = Selection{thing.node, thing.name, static_cast<uint32_t>(mesh.material), {}};
  ++action_;
  log("selected {}", thing.name);
}

void Editor::selectLight(uint32_t light) {
  selection_ = Selection{-1, scene_->lights[light].name, 0, light};
  ++action_;
}

void Editor::deselect() {
  selection_.reset();
  live_.wantPicks(false);
}

Bounds Editor::boundsOfSelection() const {
  return selection_ ? boundsOfNode(scene(), selection_->node) : Bounds{};
}

void Editor::beginDrag(DragMode mode, Vec2 place, const Shown& shown) {
  if (!selection_ || selection_->light || shown.image->picks == nullptr) return;
  const auto point = pointAt(shown, filmPosition(place, *shown.image));
  if (!point) return;
  SceneEdit thing;
  thing.objects.push_back({selection_->node, DMat4(1)});
  const DMat4 before = history_.valuesNow(thing).objects[0].motion;
  const Settings full = live_.settings();  // frames in motion may be smaller
  drag_.emplace(mode, *point, boundsOfNode(*scene_, selection_->node, before).centre(),
                filmPosition(place, full.width, full.height), before);
  ++action_;
}

void Editor::drag(Vec2 place) {
  if (!drag_) return;
  const Settings full = live_.settings();
  SceneEdit moved;
  moved.objects.push_back(
      {selection_->node, drag_->moveTo(filmPosition(place, full.width, full.height),
                                       camera_.camera(), full.width, full.height)});
  edit(moved);
}

// A lamp is a punctual light, or a surface that emits; off is black, on is as it was read.
void Editor::toggleLamp() {
  if (!selection_) return;
  SceneEdit now;
  if (selection_->light) {
    now.lights.push_back(editOf(*scene_, *selection_->light));
    LightEdit lamp = history_.valuesNow(now).lights[0];
    lamp.intensity = isBlack(lamp.intensity) ? now.lights[0].intensity : Vec3(0);
    now.lights[0] = lamp;
  } else {
    now.materials.push_back(editOfMaterial(*scene_, selection_->material));
    MaterialEdit lamp = history_.valuesNow(now).materials[0];
    lamp.emission = isBlack(lamp.emission) ? now.materials[0].emission : Vec3(0);
    now.materials[0] = lamp;
  }
  ++action_;
  edit(now);
}

void Editor::edit(const SceneEdit& edit) {
  try {
    checkEdit(*scene_, edit);
  } catch (const Error& error) {
    return warn("{}", error.what());
  }
  history_.apply(edit, action_);
  live_.edit(edit);
}

void Editor::step(const std::optional<SceneEdit>& edit) {
  if (edit) live_.edit(*edit);
  ++action_;
}

void Editor::follow(const SceneEdit& scriptStep) {
  if (scriptStep.empty()) return;
  history_.follow(scriptStep);
  live_.edit(scriptStep);
}

void Editor::take(const PanelChanges& changes) {
  if (changes.selectLight) selectLight(*changes.selectLight);
  SceneEdit turned;
  if (changes.material) turned.materials.push_back(*changes.material);
  if (changes.light) turned.lights.push_back(*changes.light);
  if (!turned.empty()) edit(turned);
  if (changes.sliderReleased && !drag_) ++action_;
  if (changes.undo) undo();
  if (changes.redo) redo();
}

void Editor::tell(PanelView& view) const {
  view.selection = selection_;
  for (const PunctualLight& light : scene_->lights) view.lights.push_back("lamp " + light.name);
  if (!selection_) return;
  SceneEdit thing;
  if (selection_->light) thing.lights.push_back(editOf(*scene_, *selection_->light));
  thing.materials.push_back(editOfMaterial(*scene_, selection_->material));
  const SceneEdit now = history_.valuesNow(thing);
  view.material = now.materials[0];
  if (selection_->light) view.light = now.lights[0];
}

}  // namespace ninefold
