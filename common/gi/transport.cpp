#include "common/gi/transport.h"

#include <map>

#include "common/math/rounding.h"

namespace ninefold {
namespace {

AimTarget sphereAround(const Bounds& bounds) {
  return {bounds.centre(), std::max(bounds.radius(), 1e-30f) * 1.0001f};
}

// World bounds of each node that holds an instance with an S lobe.
std::vector<Bounds> specularBounds(const Scene& scene, const Shader& shader) {
  std::map<int, Bounds> byNode;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
    if (!shader.isSpecular(mesh.material)) continue;
    for (const Vec3& p : mesh.positions)
      byNode[instance.node].add(Vec3(instance.toWorld * DVec4(DVec3(p), 1.0)));
  }
  std::vector<Bounds> all;
  for (const auto& [node, bounds] : byNode) all.push_back(bounds);
  return all;
}

Bounds joined(Bounds a, const Bounds& b) {
  a.add(b.low), a.add(b.high);
  return a;
}

// Joins the two boxes whose union grows least, until few enough are left. Candidates are thinned
// first by joining neighbours in file order, so that thousands of objects cost no cubic time.
void mergeTo(std::vector<Bounds>& boxes, size_t limit) {
  while (boxes.size() > 8 * limit) {
    std::vector<Bounds> halved;
    for (size_t i = 0; i + 1 < boxes.size(); i += 2)
      halved.push_back(joined(boxes[i], boxes[i + 1]));
    if (boxes.size() % 2 == 1) halved.push_back(boxes.back());
    boxes = std::move(halved);
  }
  while (boxes.size() > limit) {
    size_t bestA = 0, bestB = 1;
    float best = std::numeric_limits<float>::infinity();
    for (size_t a = 0; a < boxes.size(); ++a)
      for (size_t b = a + 1; b < boxes.size(); ++b) {
        const float r = joined(boxes[a], boxes[b]).radius();
        if (r < best) best = r, bestA = a, bestB = b;
      }
    boxes[bestA] = joined(boxes[bestA], boxes[bestB]);
    boxes.erase(boxes.begin() + static_cast<std::ptrdiff_t>(bestB));
  }
}

std::vector<AimTarget> aimTargets(const Scene& scene, const Shader& shader) {
  std::vector<Bounds> boxes = specularBounds(scene, shader);
  mergeTo(boxes, Transport::kMaxTargets);
  std::vector<AimTarget> targets;
  for (const Bounds& box : boxes) targets.push_back(sphereAround(box));
  return targets;
}

// A light exactly in a ceiling would be hidden by it: spots go where they shine, points to the front.
std::vector<PunctualLight> offSurfaces(const Tracer& tracer) {
  std::vector<PunctualLight> lights = tracer.scene().lights;
  for (PunctualLight& light : lights)
    light.position =
        tracer.clearOf(light.position, light.kind == LightKind::spot ? light.direction : Vec3(0));
  return lights;
}

}  // namespace

Transport::Transport(const Tracer& t, const Settings& s)
    : tracer(t),
      scene(t.scene()),
      settings(s),
      shader(t.scene()),
      emitters(t.scene(), s.environment),
      lights(offSurfaces(t)),
      needs(needsOf(t.scene(), s.environment)),
      bound(s.bound / std::max(t.scene().bounds.radius() * t.scene().bounds.radius(), 1e-30f)),
      farRounding(kRayRounding * 2 * t.scene().bounds.radius()),
      targets(aimTargets(t.scene(), shader)) {}

float Transport::lightBound(uint32_t emitter) const {
  if (!settings.compensate) return bound;  // the paper's: what is cut off stays away
  const Emitter& e = emitters[emitter];
  const float sides = e.doubleSided ? 2 : 1;
  return std::max(bound, emitters.byPower().probability(emitter) / (sides * e.area));
}

}  // namespace ninefold
