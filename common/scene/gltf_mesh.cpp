#include "common/scene/gltf_mesh.h"

#include <tiny_gltf.h>

#include <algorithm>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/scene/gltf_accessor.h"
#include "common/scene/mesh_cleanup.h"

namespace ninefold {
namespace {

bool hasTriangles(const tinygltf::Primitive& p) {
  return p.mode == TINYGLTF_MODE_TRIANGLES || p.mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
         p.mode == TINYGLTF_MODE_TRIANGLE_FAN;
}

// Corners of triangle t among the vertices in file order.
Triangle cornersOf(int mode, uint32_t t) {
  if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) return {t, t + 1 + t % 2, t + 2 - t % 2};
  if (mode == TINYGLTF_MODE_TRIANGLE_FAN) return {t + 1, t + 2, 0};
  return {3 * t, 3 * t + 1, 3 * t + 2};
}

uint64_t triangleCount(int mode, uint64_t corners, const std::string& what) {
  if (mode != TINYGLTF_MODE_TRIANGLES) return corners < 3 ? 0 : corners - 2;
  if (corners % 3 != 0) fail("{}: {} corners are no multiple of three", what, corners);
  return corners / 3;
}

// The elements that an attribute has for the kept vertices; empty if the primitive lacks it.
template <typename V>
std::vector<V> attribute(const GltfVertices& vertices, const tinygltf::Primitive& from,
                         const char* name) {
  const auto found = from.attributes.find(name);
  if (found == from.attributes.end()) return {};
  const GltfAccessor accessor = vertices.open(found->second, V::length(), name);
  std::vector<V> values;
  values.reserve(vertices.kept.size());
  for (const uint32_t i : vertices.kept) values.emplace_back(accessor.element(i));
  return values;
}

// COLOR_0, linear; without alpha it is opaque.
std::vector<Vec4> colorsOf(const GltfVertices& vertices, const tinygltf::Primitive& from) {
  const auto found = from.attributes.find("COLOR_0");
  if (found == from.attributes.end()) return {};
  GltfAccessor accessor = vertices.open(found->second, 3, "COLOR_0");
  accessor.takeAsNormalized();
  std::vector<Vec4> colors;
  colors.reserve(vertices.kept.size());
  for (const uint32_t i : vertices.kept) {
    const Vec4 color = accessor.element(i);
    colors.emplace_back(Vec3(color), accessor.components() > 3 ? color.w : 1.0f);
  }
  return colors;
}

constexpr uint64_t kMaxTargetVertices = 20'000'000;  // of a file

}  // namespace

// Leaves out what does not matter, so that nodes share what is the same.
GltfMeshes::Use GltfMeshes::useOf(int index) const {
  const tinygltf::Node& node = model_->nodes[static_cast<size_t>(index)];
  if (node.mesh < 0 || static_cast<size_t>(node.mesh) >= model_->meshes.size())
    fail("mesh {} does not exist", node.mesh);
  const tinygltf::Mesh& mesh = model_->meshes[static_cast<size_t>(node.mesh)];
  Use use{node.mesh, node.skin, node.weights.empty() ? mesh.weights : node.weights,
          animations_->morphs(index) ? index : -1};
  if (std::ranges::none_of(mesh.primitives, isSkinned)) use.skin = -1;
  while (!use.weights.empty() && use.weights.back() == 0) use.weights.pop_back();
  return use;
}

const std::vector<GltfShape>& GltfMeshes::use(int node) {
  const auto [entry, isNew] = known_.try_emplace(useOf(node));
  if (!isNew) return entry->second;
  const tinygltf::Mesh& from = model_->meshes[static_cast<size_t>(entry->first.mesh)];
  for (size_t i = 0; i < from.primitives.size(); ++i) {
    const tinygltf::Primitive& primitive = from.primitives[i];
    if (!hasTriangles(primitive)) {
      ++skippedPrimitives_;
      continue;
    }
    const std::string what = "mesh " + std::to_string(entry->first.mesh) + " '" + from.name +
                             "' primitive " + std::to_string(i);
    Mesh read;
    read.name = from.name;
    GltfShape shape;
    readPrimitive(primitive, entry->first, node, what, shape, read);
    if (read.triangles.empty()) continue;
    shape.mesh = static_cast<int>(scene_->meshes.size());
    entry->second.push_back(shape);
    scene_->meshes.push_back(std::move(read));
  }
  return entry->second;
}

void GltfMeshes::readPrimitive(const tinygltf::Primitive& from, const Use& use, int node,
                               const std::string& what, GltfShape& shape, Mesh& mesh) {
  const auto position = from.attributes.find("POSITION");
  if (position == from.attributes.end()) fail("{}: has no POSITION", what);
  GltfVertices vertices{model_, 0, {}, what};
  vertices.count = GltfAccessor(*model_, position->second, 3, what + " POSITION").count();
  mesh.triangles = trianglesOf(from, vertices.count, what);
  vertices.kept = compactVertices(mesh.triangles);
  mesh.positions = attribute<Vec3>(vertices, from, "POSITION");
  mesh.normals = attribute<Vec3>(vertices, from, "NORMAL");
  mesh.uv0 = attribute<Vec2>(vertices, from, "TEXCOORD_0");
  mesh.uv1 = attribute<Vec2>(vertices, from, "TEXCOORD_1");
  mesh.tangents = attribute<Vec4>(vertices, from, "TANGENT");
  mesh.colors = colorsOf(vertices, from);
  std::optional<AnimatedShape> animated = deform(from, use, vertices, shape, mesh);
  std::vector<uint32_t> kept;
  const size_t flat = cleanMesh(mesh, what, &kept);
  flatTriangles_ += flat;
  if (animated) keep(std::move(*animated), node, flat, kept);
  if (mesh.triangles.empty()) return;
  mesh.material = materials_.use(from.material);
  if (lacksCoordinates(mesh)) ++withoutCoordinates_;
}

std::optional<AnimatedShape> GltfMeshes::deform(const tinygltf::Primitive& from, const Use& use,
                                                const GltfVertices& vertices, GltfShape& shape,
                                                Mesh& mesh) {
  const bool isHeld = use.skin >= 0 && isSkinned(from);
  const bool morphs = use.morphedBy >= 0 && !from.targets.empty();
  targetVertices_ += from.targets.size() * vertices.kept.size();
  if (targetVertices_ > kMaxTargetVertices)
    fail("{}: more than {} vertices in morph targets: simplify the scene", vertices.what,
         kMaxTargetVertices);
  std::vector<MorphTarget> targets = readTargets(vertices, from, morphs ? nullptr : &use.weights);
  AnimatedShape animated;
  if (morphs) animated.positions = mesh.positions, animated.normals = mesh.normals;
  addMorphs(targets, use.weights, mesh.positions, mesh.normals);
  addOtherMorphs(vertices, from, use.weights, mesh);
  if (morphs) {
    animated.targets = std::move(targets);
    animated.weights = animations_->weightsOf(use.morphedBy, from.targets.size());
  } else {
    animated.positions = mesh.positions, animated.normals = mesh.normals;
  }
  if (isHeld) {
    animated.skin = skins_.use(use.skin);
    const Skin& skin = std::as_const(*scene_).skins[static_cast<size_t>(animated.skin)];
    animated.holds = readHolds(vertices, from, skin.joints.size());
    applySkin(animated.holds, jointMatrices(skin), mesh);
    shape.place = skin.place;
  }
  if (!morphs && (!isHeld || animations_->empty())) return std::nullopt;
  return animated;
}

// `kept`: the vertices that cleaning left.
void GltfMeshes::keep(AnimatedShape shape, int node, size_t flat,
                      const std::vector<uint32_t>& kept) {
  keepOnly(shape.positions, kept), keepOnly(shape.normals, kept);
  for (MorphTarget& target : shape.targets)
    keepOnly(target.positions, kept), keepOnly(target.normals, kept);
  shape.holds = shape.holds.of(kept);
  shape.mesh = kept.empty() ? -1 : static_cast<int>(scene_->meshes.size());
  shape.node = node, shape.flat = flat;
  scene_->shapes.push_back(std::move(shape));
}

std::vector<Triangle> GltfMeshes::trianglesOf(const tinygltf::Primitive& from, size_t vertices,
                                              const std::string& what) {
  const bool indexed = from.indices >= 0;
  const GltfAccessor list(*model_, indexed ? from.indices : from.attributes.at("POSITION"), 1,
                          what + " indices");
  if (indexed && (!list.isUnsignedInteger() || list.components() != 1))
    fail("{}: its indices are not unsigned integers", what);
  const uint64_t count = triangleCount(from.mode, list.count(), what);
  triangles_ += count;
  if (triangles_ > kMaxTriangles || vertices > std::numeric_limits<uint32_t>::max())
    fail("more than {} triangles: simplify the scene", kMaxTriangles);
  std::vector<Triangle> triangles(count);
  for (uint32_t t = 0; t < count; ++t)
    for (int corner = 0; corner < 3; ++corner) {
      const uint32_t place = cornersOf(from.mode, t)[corner];
      const uint32_t index = indexed ? list.index(place) : place;
      if (index >= vertices)
        fail("{}: index {} at place {} is out of range, there are {} vertices", what, index, place,
             vertices);
      triangles[t][corner] = index;
    }
  return triangles;
}

bool GltfMeshes::lacksCoordinates(const Mesh& mesh) const {
  const Material& m = scene_->materials[static_cast<size_t>(mesh.material)];
  for (const TextureUse* use : mapsOf(m))
    if (*use && (use->uvSet == 0 ? mesh.uv0 : mesh.uv1).empty()) return true;
  return false;
}

void GltfMeshes::warnOfLosses() const {
  if (skippedPrimitives_ > 0)
    warn("{} primitives of points or lines are left out", skippedPrimitives_);
  if (flatTriangles_ > 0) warn("{} triangles without area are left out", flatTriangles_);
  if (withoutCoordinates_ > 0)
    warn("{} meshes have textures but no texture coordinates: they show one texel",
         withoutCoordinates_);
}

}  // namespace ninefold
