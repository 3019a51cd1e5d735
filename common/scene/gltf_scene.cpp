#include "common/scene/gltf_scene.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "common/base/log.h"
#include "common/image/tone_map.h"
#include "common/scene/animation.h"
#include "common/scene/gltf_accessor.h"
#include "common/scene/gltf_animation.h"
#include "common/scene/gltf_file.h"
#include "common/scene/gltf_mesh.h"
#include "common/scene/gltf_profiles.h"
#include "common/scene/gltf_transform.h"
#include "common/scene/gltf_value.h"
#include "common/scene/reader.h"
#include "common/scene/world.h"

namespace ninefold {
namespace {

// Angles out of order or range become the nearest ones that make sense.
void setCone(const tinygltf::Light& from, PunctualLight& light) {
  constexpr float kRounding = 1e-4f;
  const auto outer = static_cast<float>(from.spot.outerConeAngle),
             inner = static_cast<float>(from.spot.innerConeAngle);
  if (!std::isfinite(outer) || !std::isfinite(inner))
    fail("light '{}': its cone is not a finite number", light.name);
  light.outerCone = std::clamp(outer, 0.0f, 0.5f * kPi);
  light.innerCone = std::clamp(inner, 0.0f, light.outerCone);
  if (std::abs(light.outerCone - outer) > kRounding ||
      std::abs(light.innerCone - inner) > kRounding)
    warn("light '{}': cone angles {:.4g} and {:.4g} are read as {:.4g} and {:.4g}", light.name,
         inner, outer, light.innerCone, light.outerCone);
}

// Flattened to a line or a point: no triangle has any area.
bool isNothing(const DMat4& m) {
  const DVec3 x(m[0]), y(m[1]), z(m[2]);
  const double lengths = glm::dot(x, x) + glm::dot(y, y) + glm::dot(z, z);
  const DVec3 a = glm::cross(x, y), b = glm::cross(y, z), c = glm::cross(z, x);
  return glm::dot(a, a) + glm::dot(b, b) + glm::dot(c, c) <= 1e-24 * lengths * lengths;
}

bool hasTargets(const tinygltf::Mesh& mesh) {
  return std::ranges::any_of(mesh.primitives,
                             [](const auto& primitive) { return !primitive.targets.empty(); });
}

DMat4 translation(DVec3 by) {
  DMat4 m(1);
  m[3] = DVec4(by, 1);
  return m;
}

class SceneBuilder {
 public:
  SceneBuilder(const GltfFile& file, const SceneFolder& folder, const ReadOptions& options)
      : model_(file.model.get()),
        meshes_(file, draft_.scene),
        profiles_(file, folder, draft_.scene),
        animations_(*model_, options.clip),
        lightUnits_(options.lightUnits),
        seen_(model_->nodes.size(), 0) {}

  SceneDraft build();

 private:
  struct Visit {
    int node;
    DMat4 parent, exactParent;  // world matrices; the first can be inverted, see gltf_transform.h
    int mover = -1;             // the nearest node above in animations_
  };
  struct Skinned {
    int skin, node;
    bool isCarried;  // in part: some of its primitives have no joints
  };
  std::vector<int> roots() const;
  std::optional<float> exposure() const;
  void enter(int node);
  void visit(const Visit& visit, std::vector<Visit>& open);
  bool addMesh(const tinygltf::Node& node, int index, const DMat4& toWorld, bool nothing);
  void findDeformed();
  void noteDeformed(int node);
  void addCamera(const tinygltf::Node& node, const DMat4& toWorld);
  void addLight(const tinygltf::Node& node, int index, const DMat4& toWorld);
  void addProfiled(const tinygltf::Node& node, const tinygltf::Value& use, const DMat4& toWorld);
  void keepLight(PunctualLight light, const DMat4& toWorld);
  void applyLightUnits();

  const tinygltf::Model* model_;
  SceneDraft draft_;
  GltfMeshes meshes_;
  GltfProfiles profiles_;
  GltfAnimations animations_;
  const LightUnits lightUnits_;
  std::vector<char> seen_;
  std::vector<Skinned> skinned_;
};

std::vector<int> SceneBuilder::roots() const {
  if (!model_->scenes.empty()) {
    const int scene = std::max(model_->defaultScene, 0);
    if (static_cast<size_t>(scene) >= model_->scenes.size()) fail("scene {} does not exist", scene);
    return model_->scenes[static_cast<size_t>(scene)].nodes;
  }
  std::vector<char> isChild(model_->nodes.size(), 0);
  for (const tinygltf::Node& node : model_->nodes)
    for (const int child : node.children)
      if (child >= 0 && static_cast<size_t>(child) < isChild.size())
        isChild[static_cast<size_t>(child)] = 1;
  std::vector<int> nodes;
  for (size_t i = 0; i < isChild.size(); ++i)
    if (isChild[i] == 0) nodes.push_back(static_cast<int>(i));
  return nodes;
}

// Anybody may write extras: what is no exposure belongs to somebody else, and is no error.
std::optional<float> SceneBuilder::exposure() const {
  if (model_->scenes.empty()) return std::nullopt;
  const auto scene = static_cast<size_t>(std::max(model_->defaultScene, 0));
  const tinygltf::Value& extras = model_->scenes[scene].extras;
  if (!extras.IsObject() || !extras.Has("exposure")) return std::nullopt;
  const tinygltf::Value& value = extras.Get("exposure");
  const double ev = value.IsNumber() ? value.GetNumberAsDouble() : NAN;
  if (std::abs(ev) <= double{kMostExposure}) return static_cast<float>(ev);
  warn("extras.exposure of the scene is no number from {} to {}: left out", -kMostExposure,
       kMostExposure);
  return std::nullopt;
}

// The nodes must form trees: that bounds the work, and a cycle would never end.
void SceneBuilder::enter(int node) {
  if (node < 0 || static_cast<size_t>(node) >= seen_.size()) fail("node {} does not exist", node);
  if (seen_[static_cast<size_t>(node)]++ != 0)
    fail("node {} is reached twice: a node must have one parent and no cycle above it", node);
}

SceneDraft SceneBuilder::build() {
  if (model_->scenes.size() > 1)
    log("{} scenes in the file: the default one is read", model_->scenes.size());
  std::vector<Visit> open;
  const std::vector<int> nodes = roots();
  for (auto node = nodes.rbegin(); node != nodes.rend(); ++node)
    open.push_back({*node, DMat4(1), DMat4(1)});
  while (!open.empty()) {
    const Visit next = open.back();
    open.pop_back();
    enter(next.node);
    try {
      visit(next, open);
    } catch (const Error& e) {
      fail("node {} '{}': {}", next.node, model_->nodes[static_cast<size_t>(next.node)].name,
           e.what());
    }
  }
  meshes_.warnOfLosses();
  applyLightUnits();
  if (model_->extensions.contains("EXT_lights_image_based"))
    warn(
        "EXT_lights_image_based is not read: its light from outside is missing; give a picture "
        "with --environment FILE.hdr or .exr");
  draft_.scene.exposure = exposure();
  draft_.scene.animated = animations_.take();
  findDeformed();
  if (!draft_.scene.deformed.empty())
    log("'{}' is shown in its rest pose: --animate cannot play skins or morph weights",
        draft_.scene.deformed);
  else if (!draft_.scene.animated.empty())
    log("{} node(s) move for {:.4g} s: --animate plays it", draft_.scene.animated.size(),
        animationEnd(draft_.scene));
  return std::move(draft_);
}

void SceneBuilder::visit(const Visit& visit, std::vector<Visit>& open) {
  const tinygltf::Node& node = model_->nodes[static_cast<size_t>(visit.node)];
  const DMat4 exact = visit.exactParent * localMatrix(node);
  const DMat4 toWorld = visit.parent * animations_.localMatrix(visit.node);
  const size_t instances = draft_.scene.instances.size(), lights = draft_.scene.lights.size(),
               cameras = draft_.scene.cameras.size();
  const int mover = animations_.enter(visit.node, visit.mover, visit.parent, toWorld);
  bool isCarried = false;  // its mesh, by the node
  if (node.mesh >= 0) isCarried = addMesh(node, visit.node, toWorld, mover < 0 && isNothing(exact));
  if (node.camera >= 0) addCamera(node, toWorld);
  if (const auto* e = extensionOf(node, "KHR_lights_punctual"))
    addLight(node, integerOr(*e, "light", -1), toWorld);
  if (const auto* e = extensionOf(node, "EXT_lights_ies")) addProfiled(node, *e, toWorld);
  if (mover >= 0) {
    AnimatedNode& moved = animations_[mover];
    moved.hasInstances = isCarried && draft_.scene.instances.size() > instances;
    moved.firstLight = static_cast<int>(lights);
    moved.lights = static_cast<int>(draft_.scene.lights.size() - lights);
    if (draft_.scene.cameras.size() > cameras) moved.camera = static_cast<int>(cameras);
  }
  for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
    open.push_back({*child, toWorld, exact, mover});
}

// Whether the mesh stands where the node says; a skin puts it elsewhere.
bool SceneBuilder::addMesh(const tinygltf::Node& node, int index, const DMat4& toWorld,
                           bool nothing) {
  const std::vector<GltfShape>& shapes = meshes_.use(node);
  const tinygltf::Mesh& mesh = model_->meshes[static_cast<size_t>(node.mesh)];
  const bool isCarried = node.skin < 0 || std::ranges::none_of(mesh.primitives, isSkinned);
  if (!isCarried)
    skinned_.push_back({node.skin, index, !std::ranges::all_of(mesh.primitives, isSkinned)});
  if (animations_.morphs(index) && hasTargets(mesh)) noteDeformed(index);
  const std::string& name = node.name.empty() ? mesh.name : node.name;
  const auto add = [&](const DMat4& copy) {
    if (nothing && isCarried) ++draft_.flatInstances;
    for (const GltfShape& shape : shapes)
      if (shape.place)
        draft_.addInstance(shape.mesh, index, name, copy * translation(*shape.place));
      else if (!nothing)
        draft_.addInstance(shape.mesh, index, name, toWorld * copy);
  };
  const auto* e = extensionOf(node, "EXT_mesh_gpu_instancing");
  if (e == nullptr) return add(DMat4(1)), isCarried;
  const CopyMatrices copies(*model_, *e);
  if (copies.count() > kMaxInstances) fail("more than {} instances: merge objects", kMaxInstances);
  for (size_t i = 0; i < copies.count(); ++i)
    copies.vanishes(i) ? void(++draft_.flatInstances) : add(copies.matrix(i));
  return isCarried;
}

// Joints that move deform a mesh; so does its own node if only a part of the mesh is skinned.
void SceneBuilder::findDeformed() {
  std::set<int> moving;
  for (const AnimatedNode& node : draft_.scene.animated) moving.insert(node.node);
  std::map<int, bool> bends;  // by skin
  const auto moves = [&](int node) { return moving.contains(node); };
  for (const Skinned& object : skinned_) {
    const auto [entry, isNew] = bends.try_emplace(object.skin);
    const auto skin = static_cast<size_t>(object.skin);
    if (isNew && skin < model_->skins.size())
      entry->second = std::ranges::any_of(model_->skins[skin].joints, moves);
    if (entry->second || (object.isCarried && moves(object.node))) noteDeformed(object.node);
  }
}

// Keeps the first one: it stands for all.
void SceneBuilder::noteDeformed(int node) {
  std::string& name = draft_.scene.deformed;
  if (name.empty()) name = model_->nodes[static_cast<size_t>(node)].name;
  if (name.empty()) name = "node " + std::to_string(node);
}

void SceneBuilder::addCamera(const tinygltf::Node& node, const DMat4& toWorld) {
  if (static_cast<size_t>(node.camera) >= model_->cameras.size())
    fail("camera {} does not exist", node.camera);
  const tinygltf::Camera& from = model_->cameras[static_cast<size_t>(node.camera)];
  if (from.type != "perspective") {
    warn(
        "camera '{}' is not perspective: left out; one that is far away and has a narrow angle "
        "looks nearly the same",
        node.name);
    return;
  }
  Camera camera;
  camera.name = node.name.empty() ? from.name : node.name;
  camera.forward = unitOr(-DVec3(toWorld[2]), Vec3(0, 0, -1));
  camera.up = unitOr(DVec3(toWorld[1]), Vec3(0, 1, 0));
  camera.verticalFov = static_cast<float>(from.perspective.yfov);
  draft_.scene.cameras.push_back(camera);
  draft_.eyes.emplace_back(toWorld[3]);
}

void SceneBuilder::addLight(const tinygltf::Node& node, int index, const DMat4& toWorld) {
  if (index < 0 || static_cast<size_t>(index) >= model_->lights.size())
    fail("light {} does not exist", index);
  const tinygltf::Light& from = model_->lights[static_cast<size_t>(index)];
  PunctualLight light;
  light.name = node.name.empty() ? from.name : node.name;
  if (from.type == "spot")
    light.kind = LightKind::spot;
  else if (from.type == "directional")
    light.kind = LightKind::directional;
  else if (from.type != "point")
    fail("light {} is of the unknown type '{}'", index, from.type);
  const auto strength = static_cast<float>(from.intensity);
  light.intensity = Vec3(strength);
  for (int c = 0; c < 3 && from.color.size() == 3; ++c)
    light.intensity[c] *= static_cast<float>(from.color[static_cast<size_t>(c)]);
  if (light.kind == LightKind::spot) setCone(from, light);
  keepLight(std::move(light), toWorld);
}

// The matrix turns it, and mirrors what it sends if the matrix mirrors; its size is of no account.
void SceneBuilder::addProfiled(const tinygltf::Node& node, const tinygltf::Value& use,
                               const DMat4& toWorld) {
  const GltfProfiles::Light from = profiles_.use(use, mirrors(toWorld));
  PunctualLight light;
  light.name =
      node.name.empty() ? draft_.scene.profiles[static_cast<size_t>(from.profile)].name : node.name;
  light.kind = LightKind::goniometric;
  light.profile = from.profile, light.intensity = from.intensity;
  keepLight(std::move(light), toWorld);
  PunctualLight& kept = draft_.scene.lights.back();
  kept.across = acrossAxis(kept.direction, unitOr(DVec3(toWorld[0]), kept.across));
}

void SceneBuilder::keepLight(PunctualLight light, const DMat4& toWorld) {
  light.direction = unitOr(-DVec3(toWorld[2]), Vec3(0, 0, -1));
  draft_.scene.lights.push_back(std::move(light));
  draft_.lightPositions.emplace_back(toWorld[3]);
}

// All lamps together, as one file has one unit.
void SceneBuilder::applyLightUnits() {
  std::vector<PunctualLight>& lights = draft_.scene.lights;
  if (lights.empty()) return;
  float brightest = 0;
  for (const PunctualLight& light : lights)
    brightest = std::max(brightest, maxComponent(light.intensity));
  const LightReading reading =
      readingOf(lightUnits_, model_->asset.generator, static_cast<double>(brightest));
  reading.isDoubtful ? warn("{}", reading.line) : log("{}", reading.line);
  if (!reading.isPhotometric) return;
  for (PunctualLight& light : lights) light.intensity /= static_cast<float>(kLumensPerWatt);
}

}  // namespace

SceneDraft readGltf(std::span<const unsigned char> file, const SceneFolder& folder,
                    const ReadOptions& options) {
  const GltfFile parsed = parseGltf(file, folder);
  return SceneBuilder(parsed, folder, options).build();
}

}  // namespace ninefold
