// random_edits.h: a session of somebody who moves, turns and twists everything, except the room
// that all the rest is in: a room that moves takes the view.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <vector>

#include "common/scene/edit.h"
#include "common/scene/twist.h"
#include "common/scene/world.h"

namespace ninefold {

class RandomEdits {
 public:
  RandomEdits(const Scene& scene, uint32_t seed) : scene_(scene), random_(seed) {
    for (const Instance& instance : scene.instances) {
      Bounds bounds;
      for (const Vec3& p : scene.meshes[static_cast<size_t>(instance.mesh)].positions)
        bounds.add(worldPoint(instance.toWorld, p));
      const bool holdsTheRest = bounds.radius() > 0.7f * scene.bounds.radius();
      if (holdsTheRest) still_.insert(instance.node);
      if (nodes_.empty() || nodes_.back() != instance.node) nodes_.push_back(instance.node);
    }
    std::erase_if(nodes_, [this](int node) { return still_.contains(node); });
  }

  SceneEdit next() {
    SceneEdit edit;
    const int things = 1 + static_cast<int>(random_() % 2);
    for (int i = 0; i < things; ++i) {
      const auto dice = random_() % 10;
      if (dice < 5) edit.objects.push_back(motion());
      if (dice == 5) edit.shapes = shape();
      if (dice == 6 && !scene_.lights.empty()) edit.lights.push_back(light());
      if (dice > 6) edit.materials.push_back(material());
    }
    SceneEdit once;
    merge(once, edit);
    return once;
  }

 private:
  double real(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  ObjectEdit motion() {
    ObjectEdit edit;
    edit.node = nodes_[random_() % nodes_.size()];
    const double angle = real(-0.3, 0.3), c = std::cos(angle), s = std::sin(angle);
    edit.motion = DMat4(DVec4(c, 0, -s, 0), DVec4(0, 1, 0, 0), DVec4(s, 0, c, 0),
                        DVec4(real(-0.3, 0.3), real(0, 0.2), real(-0.3, 0.3), 1));
    if (random_() % 8 == 0) edit.motion = DMat4(1);  // back where it was
    return edit;
  }
  std::vector<ShapeEdit> shape() {
    const int node = nodes_[random_() % nodes_.size()];
    const auto found = std::ranges::find(scene_.instances, node, &Instance::node);
    Bounds bounds;
    for (const Vec3& p : scene_.meshes[static_cast<size_t>(found->mesh)].positions)
      bounds.add(worldPoint(found->toWorld, p));
    const Twist twist{DVec3(bounds.centre()), double{bounds.low.y}, double{bounds.high.y} + 0.01,
                      random_() % 8 == 0 ? 0 : real(-1, 1)};
    return twisted(scene_, static_cast<uint32_t>(found->mesh), found->toWorld, twist);
  }
  LightEdit light() {
    LightEdit edit = editOf(scene_, static_cast<uint32_t>(random_() % scene_.lights.size()));
    const auto real = [this] { return static_cast<float>(this->real(-0.3, 0.3)); };
    edit.position += Vec3(real(), real(), real());
    edit.direction = glm::normalize(edit.direction + Vec3(real(), real(), real()));
    edit.intensity *= 1 + real();
    return edit;
  }
  MaterialEdit material() {
    const auto index = static_cast<uint32_t>(random_() % scene_.materials.size());
    MaterialEdit edit = editOfMaterial(scene_, index);
    const auto unit = [this] { return static_cast<float>(real(0, 1)); };
    edit.baseColor = Vec3(unit(), unit(), unit());
    edit.roughness = unit(), edit.metallic = random_() % 4 == 0 ? 1.0f : 0.0f;
    edit.transmission = random_() % 4 == 0 ? 1.0f : 0.0f;
    edit.ior = 1 + unit();
    edit.emission *= 2 * unit();
    return edit;
  }

  const Scene& scene_;
  std::mt19937 random_;
  std::vector<int> nodes_;
  std::set<int> still_;
};

}  // namespace ninefold
