#include "common/scene/animation.h"

#include <fmt/core.h>

#include <algorithm>

#include "common/scene/gltf_transform.h"

namespace ninefold {
namespace {

// Where a time lies in a track: between key i and the next, or on key i.
struct Place {
  size_t i;
  double length, s;  // [s]; share of the way to the next key, 0 on key i
};

Place find(const AnimationTrack& track, double time) {
  const auto next =
      std::ranges::upper_bound(track.times, time, {}, [](float t) { return double(t); });
  if (next == track.times.begin()) return {0, 0, 0};
  const auto i = static_cast<size_t>(next - track.times.begin()) - 1;
  if (next == track.times.end()) return {i, 0, 0};
  const double from = double(track.times[i]), length = double(*next) - from;
  return {i, length, (time - from) / length};
}

DVec4 cubic(const AnimationTrack& track, const Place& at) {
  const auto part = [&](size_t key, size_t which) { return track.values[3 * key + which]; };
  if (at.s == 0) return part(at.i, 1);
  const double s = at.s, s2 = s * s, s3 = s2 * s, d = at.length;
  return (2 * s3 - 3 * s2 + 1) * part(at.i, 1) + d * (s3 - 2 * s2 + s) * part(at.i, 2) +
         (3 * s2 - 2 * s3) * part(at.i + 1, 1) + d * (s3 - s2) * part(at.i + 1, 0);
}

DVec4 valueAt(const AnimationTrack& track, double time) {
  const Place at = find(track, time);
  if (track.kind == AnimationTrack::Kind::cubic) return cubic(track, at);
  const DVec4 a = track.values[at.i];
  if (track.kind == AnimationTrack::Kind::step || at.s == 0) return a;
  return a + at.s * (track.values[at.i + 1] - a);
}

// Along the great arc from a to b or -b, whichever is nearer: both are the same rotation.
DVec4 alongArc(DVec4 a, DVec4 b, double s) {
  a = glm::normalize(a), b = glm::normalize(b);
  double cosine = glm::dot(a, b);
  if (cosine < 0) b = -b, cosine = -cosine;
  const double angle = std::acos(std::min(cosine, 1.0));
  if (angle < 1e-6) return a + s * (b - a);
  return (std::sin((1 - s) * angle) * a + std::sin(s * angle) * b) / std::sin(angle);
}

DVec4 rotationAt(const AnimationTrack& track, double time) {
  const Place at = find(track, time);
  if (track.kind == AnimationTrack::Kind::linear && at.s > 0)
    return alongArc(track.values[at.i], track.values[at.i + 1], at.s);
  const DVec4 q = valueAt(track, time);
  // A cubic track's tangents may lead through 0, which is no rotation.
  return glm::length(q) > 1e-9 ? q : track.values[3 * at.i + 1];
}

DMat4 localAt(const AnimatedNode& node, double time) {
  if (node.fixed) return *node.fixed;
  return placement(DVec3(valueAt(node.translation, time)), rotationAt(node.rotation, time),
                   liftedScale(DVec3(valueAt(node.scale, time)), node.largestScale));
}

// World matrices of all nodes that move, in file coordinates.
std::vector<DMat4> worldsAt(const Scene& scene, double time) {
  std::vector<DMat4> worlds;
  for (const AnimatedNode& node : scene.animated) {
    const DMat4& above = node.parent < 0 ? node.above : worlds[static_cast<size_t>(node.parent)];
    worlds.push_back(above * localAt(node, time));
  }
  return worlds;
}

// motion(t), in scene coordinates.
DMat4 motionOf(const AnimatedNode& node, const DMat4& world, DVec3 origin) {
  if (world == node.asRead) return DMat4(1);
  DMat4 toFile(1), toScene(1);
  toFile[3] = DVec4(origin, 1), toScene[3] = DVec4(-origin, 1);
  DMat4 motion = toScene * (world * glm::inverse(node.asRead)) * toFile;
  for (int column = 0; column < 4; ++column) motion[column][3] = column == 3 ? 1 : 0;
  return motion;
}

// The skin acts on what the weights have made.
std::vector<ShapeEdit> shapeAt(const Scene& scene, const AnimatedShape& shape,
                               std::span<const DMat4> worlds, double time) {
  std::vector<double> weights;
  for (const AnimationTrack& track : shape.weights) weights.push_back(valueAt(track, time).x);
  std::vector<Vec3> positions = shape.positions, normals = shape.normals;
  addMorphs(shape.targets, weights, positions, normals);
  const bool isHeld = shape.skin >= 0;
  const std::vector<DMat4> joints =
      isHeld ? jointMatrices(scene.skins[static_cast<size_t>(shape.skin)], worlds)
             : std::vector<DMat4>();
  for (size_t i = 0; i < positions.size(); ++i) {
    const DMat4 m = isHeld ? shape.holds.matrixOf(i, joints) : DMat4(1);
    if (isHeld) positions[i] = Vec3(DVec3(m * DVec4(DVec3(positions[i]), 1)));
    if (!normals.empty())
      normals[i] = unitOr(normalMatrix(DMat3(m)) * DVec3(normals[i]), Vec3(0, 1, 0));
  }
  return shapeEdits(static_cast<uint32_t>(shape.mesh), positions, normals);
}

}  // namespace

std::string whyNotPlayed(const Scene& scene) {
  if (!scene.unplayable.empty())
    return fmt::format(
        "the animation moves '{}', of which only a part hangs on joints, and that cannot be "
        "played: leave it out to see the rest pose",
        scene.unplayable);
  size_t vertices = 0;
  for (const AnimatedShape& shape : scene.shapes) vertices += shape.positions.size();
  if (vertices > kMaxShapeVertices)
    return fmt::format(
        "the animation deforms meshes of {} vertices, at most {} can be played: simplify them, or "
        "leave it out to see the rest pose",
        vertices, kMaxShapeVertices);
  if (scene.animated.empty() && scene.shapes.empty()) return "nothing is animated in the scene";
  return {};
}

SceneEdit animationAt(const Scene& scene, double time) {
  const std::vector<DMat4> worlds = worldsAt(scene, time);
  SceneEdit moved;
  for (size_t i = 0; i < worlds.size(); ++i) {
    const AnimatedNode& node = scene.animated[i];
    if (node.hasInstances)
      moved.objects.push_back({node.node, motionOf(node, worlds[i], scene.origin)});
    for (int l = node.firstLight; l < node.firstLight + node.lights; ++l) {
      LightEdit light = editOf(scene, static_cast<uint32_t>(l));
      light.position = Vec3(DVec3(worlds[i][3]) - scene.origin);
      light.direction = unitOr(-DVec3(worlds[i][2]), light.direction);
      if (scene.lights[static_cast<size_t>(l)].kind == LightKind::goniometric)
        light.across = acrossAxis(light.direction, unitOr(DVec3(worlds[i][0]), light.across));
      moved.lights.push_back(light);
    }
  }
  for (const AnimatedShape& shape : scene.shapes)
    for (ShapeEdit& piece : shapeAt(scene, shape, worlds, time))
      moved.shapes.push_back(std::move(piece));
  SceneEdit ordered;
  merge(ordered, moved);
  return ordered;
}

Camera animatedCamera(const Scene& scene, const Camera& camera, double time) {
  const auto own = std::ranges::find(scene.cameras, camera);
  if (own == scene.cameras.end()) return camera;
  const auto moves = [&](const AnimatedNode& node) {
    return node.camera == own - scene.cameras.begin();
  };
  const auto node = std::ranges::find_if(scene.animated, moves);
  if (node == scene.animated.end()) return camera;
  const DMat4 world = worldsAt(scene, time)[static_cast<size_t>(node - scene.animated.begin())];
  Camera moved = camera;
  moved.eye = Vec3(DVec3(world[3]) - scene.origin);
  moved.forward = unitOr(-DVec3(world[2]), camera.forward);
  moved.up = unitOr(DVec3(world[1]), camera.up);
  return moved;
}

double animationEnd(const Scene& scene) {
  float end = 0;
  for (const AnimatedNode& node : scene.animated)
    for (const AnimationTrack* track : {&node.translation, &node.rotation, &node.scale})
      if (!track->times.empty()) end = std::max(end, track->times.back());
  for (const AnimatedShape& shape : scene.shapes)
    for (const AnimationTrack& track : shape.weights) end = std::max(end, track.times.back());
  return double(end);
}

}  // namespace ninefold
