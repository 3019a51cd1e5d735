#include "common/scene/gltf_transform.h"

#include "common/scene/gltf_value.h"

namespace ninefold {
namespace {

// q = (x, y, z, w), any length but 0.
DMat4 rotationMatrix(DVec4 q) {
  const double length = glm::length(q);
  if (!(length > 1e-12)) fail("its rotation is no quaternion");
  q /= length;
  const double x = q.x, y = q.y, z = q.z, w = q.w;
  return DMat4(DVec4(1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w), 0),
               DVec4(2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w), 0),
               DVec4(2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y), 0),
               DVec4(0, 0, 0, 1));
}

template <typename Vector>
Vector vectorFrom(const std::vector<double>& from, Vector otherwise) {
  if (from.empty()) return otherwise;
  if (from.size() != static_cast<size_t>(Vector::length()))
    fail("its transform has too few numbers");
  Vector v;
  for (int i = 0; i < Vector::length(); ++i) v[i] = from[static_cast<size_t>(i)];
  return v;
}

}  // namespace

DMat4 placement(DVec3 translation, DVec4 rotation, DVec3 scale) {
  DMat4 m = rotationMatrix(rotation);
  for (int column = 0; column < 3; ++column) m[column] *= scale[column];
  m[3] = DVec4(translation, 1);
  return m;
}

double maxAxis(DVec3 scale) {
  return std::max({std::abs(scale.x), std::abs(scale.y), std::abs(scale.z)});
}

DVec3 liftedScale(DVec3 scale, double largest) {
  const double least = kSmallestScale * (largest > 0 ? largest : 1);
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(scale[axis]) < least) scale[axis] = std::copysign(least, scale[axis]);
  return scale;
}

Vec3 unitOr(DVec3 v, Vec3 otherwise) {
  const double length = glm::length(v);
  return length > 0 && std::isfinite(length) ? Vec3(v / length) : otherwise;
}

DMat4 localMatrix(const tinygltf::Node& node) {
  if (node.matrix.empty())
    return placement(vectorFrom(node.translation, DVec3(0)),
                     vectorFrom(node.rotation, DVec4(0, 0, 0, 1)),
                     vectorFrom(node.scale, DVec3(1)));
  if (node.matrix.size() != 16) fail("its matrix does not have 16 numbers");
  DMat4 m;
  for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = node.matrix[static_cast<size_t>(i)];
  constexpr double kTolerance = 1e-6;
  for (int column = 0; column < 4; ++column) {
    const double exact = column == 3 ? 1 : 0;
    if (!(std::abs(m[column][3] - exact) <= kTolerance)) fail("its matrix is not affine");
    m[column][3] = exact;
  }
  return m;
}

CopyMatrices::CopyMatrices(const tinygltf::Model& model, const tinygltf::Value& extension) {
  if (!extension.Has("attributes")) fail("EXT_mesh_gpu_instancing has no attributes");
  const tinygltf::Value& attributes = extension.Get("attributes");
  bool first = true;
  const auto open = [&](const char* name, int components, std::optional<GltfAccessor>& to) {
    if (!attributes.IsObject() || !attributes.Has(name)) return;
    to.emplace(model, integerOr(attributes, name, -1), components,
               std::string("EXT_mesh_gpu_instancing ") + name);
    if (!first && to->count() != count_) fail("EXT_mesh_gpu_instancing: counts differ");
    count_ = to->count(), first = false;
  };
  open("TRANSLATION", 3, translation_);
  open("ROTATION", 4, rotation_);
  open("SCALE", 3, scale_);
}

DMat4 CopyMatrices::matrix(size_t i) const {
  const DVec3 scale = scaleOf(i);
  return placement(translation_ ? DVec3(translation_->element(i)) : DVec3(0),
                   rotation_ ? DVec4(rotation_->element(i)) : DVec4(0, 0, 0, 1),
                   liftedScale(scale, maxAxis(scale)));
}

DVec3 CopyMatrices::scaleOf(size_t i) const {
  return scale_ ? DVec3(scale_->element(i)) : DVec3(1);
}

bool CopyMatrices::vanishes(size_t i) const {
  const DVec3 scale = scaleOf(i);
  return (scale.x == 0) + (scale.y == 0) + (scale.z == 0) >= 2;
}

}  // namespace ninefold
