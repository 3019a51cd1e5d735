#include "master/options/script.h"

#include <cmath>
#include <iterator>
#include <set>

#include "common/base/error.h"
#include "common/scene/animation.h"
#include "common/scene/twist.h"
#include "master/interaction/drag.h"

namespace ninefold {
namespace {

double share(const Script::Event& event, double time) {
  if (time >= event.to) return 1;
  return (time - event.from) / (event.to - event.from);
}

template <typename T>
T blend(const T& a, const T& b, float s) {
  return (1 - s) * a + s * b;
}

Camera along(const std::vector<Camera>& path, double s) {
  if (path.size() == 1) return path.front();
  const double place = s * static_cast<double>(path.size() - 1);
  const size_t i = std::min(static_cast<size_t>(place), path.size() - 2);
  const auto t = static_cast<float>(place - static_cast<double>(i));
  const Camera &a = path[i], &b = path[i + 1];
  Camera camera = a;
  camera.eye = blend(a.eye, b.eye, t);
  camera.forward = glm::normalize(blend(a.forward, b.forward, t));
  camera.up = blend(a.up, b.up, t);
  camera.verticalFov = blend(a.verticalFov, b.verticalFov, t);
  camera.orthographicHeight = blend(a.orthographicHeight, b.orthographicHeight, t);
  return camera;
}

LightEdit between(const LightEdit& a, const LightEdit& b, float s) {
  return {b.light, blend(a.position, b.position, s),
          glm::normalize(blend(a.direction, b.direction, s)), blend(a.intensity, b.intensity, s),
          b.across};
}

MaterialEdit between(const MaterialEdit& a, const MaterialEdit& b, float s) {
  return {b.material,
          blend(a.baseColor, b.baseColor, s),
          blend(a.metallic, b.metallic, s),
          blend(a.roughness, b.roughness, s),
          blend(a.transmission, b.transmission, s),
          blend(a.ior, b.ior, s),
          blend(a.emission, b.emission, s)};
}

DMat4 motionOf(const SceneEdit& edit, int node) {
  for (const ObjectEdit& object : edit.objects)
    if (object.node == node) return object.motion;
  return DMat4(1);
}

// Each mesh once, in the place as read of the first object that has it.
std::vector<ShapeEdit> twistedBy(const Script::Event& event, double s, const Scene& scene,
                                 const SceneEdit& before) {
  const Scene now = edited(scene, before);
  std::vector<ShapeEdit> shapes;
  std::set<int> done;
  for (const Instance& instance : scene.instances) {
    if (std::ranges::find(event.nodes, instance.node) == event.nodes.end()) continue;
    if (!done.insert(instance.mesh).second) continue;
    const Twist twist{event.centre, event.low, event.high, s * event.twist};
    std::ranges::copy(twisted(now, static_cast<uint32_t>(instance.mesh), instance.toWorld, twist),
                      std::back_inserter(shapes));
  }
  return shapes;
}

}  // namespace

int Script::pictures() const {
  const double perSecond = rate ? *rate : *shots;
  return static_cast<int>(std::floor(seconds * perSecond + 1e-9)) + 1;
}

ScriptState Script::at(double time, const Scene& scene, const Camera& start) const {
  ScriptState state{start, {}};
  for (const Event& event : events) {
    if (time < event.from) continue;
    const double s = share(event, time);
    SceneEdit step;
    switch (event.kind) {
      case Event::Kind::camera:
        state.camera = along(event.path, s);
        break;
      case Event::Kind::object:
        for (const int node : event.nodes)
          step.objects.push_back(
              {node, shift(s * event.by) * turnAbout(event.centre, s * event.turn) *
                         motionOf(state.edit, node)});
        if (event.twist != 0) step.shapes = twistedBy(event, s, scene, state.edit);
        break;
      case Event::Kind::light: {
        const Scene now = edited(scene, state.edit);
        step.lights.push_back(
            between(editOf(now, event.light.light), event.light, static_cast<float>(s)));
        break;
      }
      case Event::Kind::material: {
        const Scene now = edited(scene, state.edit);
        step.materials.push_back(between(editOfMaterial(now, event.material.material),
                                         event.material, static_cast<float>(s)));
        break;
      }
      case Event::Kind::animation: {
        const double played = event.playedFrom + s * (event.playedTo - event.playedFrom);
        state.camera = animatedCamera(scene, state.camera, played);
        step = animationAt(scene, played);
        break;
      }
    }
    merge(state.edit, step);
  }
  return state;
}

Script playedAnimation(const AnimationRange& range, int frames, const Scene& scene) {
  if (const std::string why = whyNotPlayed(scene); !why.empty()) fail("--animate: {}", why);
  Script script;
  script.seconds = range.to - range.from;
  script.rate = range.rate;
  script.frames = frames;
  Script::Event event;
  event.kind = Script::Event::Kind::animation;
  event.to = script.seconds;
  event.playedFrom = range.from, event.playedTo = range.to;
  script.events.push_back(event);
  return script;
}

}  // namespace ninefold
