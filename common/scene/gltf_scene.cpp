#include "common/scene/gltf_scene.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "common/base/log.h"
#include "common/image/tone_map.h"
#include "common/scene/animation.h"
#include "common/scene/gltf_accessor.h"
#include "common/scene/gltf_animation.h"
#include "common/scene/gltf_file.h"
#include "common/scene/gltf_image_light.h"
#include "common/scene/gltf_lights.h"
#include "common/scene/gltf_mesh.h"
#include "common/scene/gltf_transform.h"
#include "common/scene/gltf_value.h"
#include "common/scene/reader.h"
#include "common/scene/world.h"

namespace ninefold {
namespace {

// Flattened to a line or a point: no triangle has any area.
bool isNothing(const DMat4& m) {
  const DVec3 x(m[0]), y(m[1]), z(m[2]);
  const double lengths = glm::dot(x, x) + glm::dot(y, y) + glm::dot(z, z);
  const DVec3 a = glm::cross(x, y), b = glm::cross(y, z), c = glm::cross(z, x);
  return glm::dot(a, a) + glm::dot(b, b) + glm::dot(c, c) <= 1e-24 * lengths * lengths;
}

// A picture shows 2 ymag of height, and of width what its shape says. Mirrored ones are not meant.
float heightOf(const tinygltf::OrthographicCamera& camera, const std::string& name) {
  const auto height = static_cast<float>(2 * std::abs(camera.ymag));
  if (!(height > 0 && height <= kLargestFilm))
    fail("camera '{}': its ymag is {}, and must be above 0", name, camera.ymag);
  return height;
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
        animations_(*model_, options.clip),
        meshes_(file, animations_, draft_.scene),
        lights_(file, folder, draft_),
        lightUnits_(options.lightUnits),
        seen_(model_->nodes.size(), 0) {}

  SceneDraft build();

 private:
  struct Visit {
    int node;
    DMat4 parent, exactParent;  // world matrices; the first can be inverted, see gltf_transform.h
    int mover = -1;             // the nearest node above in animations_
  };
  std::vector<int> roots() const;
  std::optional<float> exposure() const;
  void enter(int node);
  void visit(const Visit& visit, std::vector<Visit>& open);
  bool addMesh(const tinygltf::Node& node, int index, const DMat4& toWorld, bool nothing);
  void findMovingShapes();
  bool bends(int skin) const;
  std::string nameOf(int node) const;
  void addCamera(const tinygltf::Node& node, const DMat4& toWorld);

  const tinygltf::Model* model_;
  SceneDraft draft_;
  GltfAnimations animations_;
  GltfMeshes meshes_;
  GltfLights lights_;
  const LightUnits lightUnits_;
  std::vector<char> seen_;
  std::vector<int> partlyCarried_;  // nodes: some primitives of their meshes have no joints
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
  lights_.applyUnits(lightUnits_);
  draft_.scene.exposure = exposure();
  draft_.scene.animated = animations_.take();
  findMovingShapes();
  const Scene& scene = draft_.scene;
  if (const std::string why = whyNotPlayed(scene); why.empty())
    log("{} node(s) move{} for {:.4g} s: --animate plays it", scene.animated.size(),
        scene.shapes.empty() ? "" : fmt::format(" and {} mesh(es) deform", scene.shapes.size()),
        animationEnd(scene));
  else if (!animations_.empty())
    log("{}", why);
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
  lights_.add(node, toWorld);
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
  const std::vector<GltfShape>& shapes = meshes_.use(index);
  const tinygltf::Mesh& mesh = model_->meshes[static_cast<size_t>(node.mesh)];
  const bool isCarried = node.skin < 0 || std::ranges::none_of(mesh.primitives, isSkinned);
  if (!isCarried && !std::ranges::all_of(mesh.primitives, isSkinned))
    partlyCarried_.push_back(index);
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

// Joints and weights that move deform a mesh: only such shapes stay.
void SceneBuilder::findMovingShapes() {
  Scene& scene = draft_.scene;
  std::map<int, int> movers;  // by node of the file
  for (const AnimatedNode& node : scene.animated)
    movers.emplace(node.node, static_cast<int>(movers.size()));
  for (Skin& skin : scene.skins)
    for (Joint& joint : skin.joints)
      if (const auto mover = movers.find(joint.node); mover != movers.end())
        joint.mover = mover->second;
  std::vector<AnimatedShape> moving;
  for (AnimatedShape& shape : scene.shapes) {
    if (shape.weights.empty() && !bends(shape.skin)) continue;
    if (shape.flat > 0)
      warn("'{}': {} triangles without area in the rest pose stay away while it plays",
           nameOf(shape.node), shape.flat);
    if (shape.mesh >= 0) moving.push_back(std::move(shape));
  }
  scene.shapes = std::move(moving);
  for (const int node : partlyCarried_)
    if (movers.contains(node) && scene.unplayable.empty()) scene.unplayable = nameOf(node);
}

bool SceneBuilder::bends(int skin) const {
  if (skin < 0) return false;
  const auto moves = [](const Joint& joint) { return joint.mover >= 0; };
  return std::ranges::any_of(draft_.scene.skins[static_cast<size_t>(skin)].joints, moves);
}

std::string SceneBuilder::nameOf(int node) const {
  const std::string& name = model_->nodes[static_cast<size_t>(node)].name;
  return name.empty() ? "node " + std::to_string(node) : name;
}

void SceneBuilder::addCamera(const tinygltf::Node& node, const DMat4& toWorld) {
  if (static_cast<size_t>(node.camera) >= model_->cameras.size())
    fail("camera {} does not exist", node.camera);
  const tinygltf::Camera& from = model_->cameras[static_cast<size_t>(node.camera)];
  Camera camera;
  camera.name = node.name.empty() ? from.name : node.name;
  camera.forward = unitOr(-DVec3(toWorld[2]), Vec3(0, 0, -1));
  camera.up = unitOr(DVec3(toWorld[1]), Vec3(0, 1, 0));
  if (from.type == "orthographic")
    camera.orthographicHeight = heightOf(from.orthographic, camera.name);
  else
    camera.verticalFov = static_cast<float>(from.perspective.yfov);
  draft_.scene.cameras.push_back(camera);
  draft_.eyes.emplace_back(toWorld[3]);
}

}  // namespace

SceneDraft readGltf(std::span<const unsigned char> file, const SceneFolder& folder,
                    const ReadOptions& options) {
  const GltfFile parsed = parseGltf(file, folder);
  SceneDraft draft = SceneBuilder(parsed, folder, options).build();
  if (options.isLitFromOutside()) return draft;
  const ImageLight light = readImageLight(parsed);
  draft.scene.environmentMap = light.map;
  if (light.map) draft.scene.environment = Radiance(light.intensity);
  return draft;
}

}  // namespace ninefold
