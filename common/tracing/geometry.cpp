#include "common/tracing/geometry.h"

#include "common/base/error.h"
#include "common/math/basis.h"
#include "common/math/rounding.h"

namespace ninefold {
namespace {

template <typename T>
T interpolate(const std::vector<T>& values, const Triangle& t, const Vec3& weights) {
  return weights.x * values[t.x] + weights.y * values[t.y] + weights.z * values[t.z];
}

// Largest component to 1, so that no scale of an instance leaves the range of floats.
Mat3 normalized(const DMat3& m) {
  double largest = 0;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) largest = std::max(largest, std::abs(m[column][row]));
  return Mat3(m / (largest > 0 ? largest : 1.0));
}

// Columns of the matrix of cofactors: det(M) times the inverse transpose, free of divisions.
DMat3 cofactors(const DMat3& m) {
  return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

// Weights of the three corners with u, v moved into the triangle: far away or grazing rays miss by
// some ulps.
Vec3 clampedWeights(float u, float v) {
  u = std::max(u, 0.0f), v = std::max(v, 0.0f);
  if (u + v > 1) {
    const float sum = u + v;
    u /= sum, v /= sum;
  }
  return Vec3(std::max(0.0f, 1 - u - v), u, v);
}

Vec3 unitOr(const Vec3& v, const Vec3& fallback) {
  const float length = glm::length(v);
  return length > 0 && std::isfinite(length) ? v / length : fallback;
}

// A triangle without area has some normal, too.
Vec3 facing(const Vec3& normal) { return isBlack(normal) ? Vec3(0, 0, 1) : normal; }

// d(position)/d(s, t) of a triangle's texture coordinates, up to a positive factor; 0 if they are
// degenerate.
struct UvGradient {
  Vec3 alongS, alongT;
};
UvGradient uvGradient(const std::vector<Vec2>& uv, const Triangle& t, const Tracer::Corners& at) {
  const Vec2 d1 = uv[t.y] - uv[t.x], d2 = uv[t.z] - uv[t.x];
  const float sign = d1.x * d2.y - d1.y * d2.x < 0 ? -1.0f : 1.0f;
  const Vec3 e1 = at.b - at.a, e2 = at.c - at.a;
  return {sign * (d2.y * e1 - d1.y * e2), sign * (d1.x * e2 - d2.x * e1)};
}

}  // namespace

InstanceGeometry::InstanceGeometry(const Scene& scene, const Instance& instance)
    : mesh_(scene.meshes.share(static_cast<size_t>(instance.mesh))),
      tangents_(scene.materials[static_cast<size_t>(mesh_->material)].normalMap) {
  flatten(instance);
  const DMat3 linear(instance.toWorld);
  const DMat3 cofactor = cofactors(linear);
  handedness_ = glm::dot(linear[0], cofactor[0]) < 0 ? -1.0f : 1.0f;
  directionToWorld_ = normalized(linear);
  normalToWorld_ = handedness_ * normalized(cofactor);
  planes_.reserve(mesh_->triangles.size());
  for (uint32_t i = 0; i < mesh_->triangles.size(); ++i) planes_.push_back(planeOf(i));
}

InstanceGeometry::Plane InstanceGeometry::planeOf(uint32_t triangle) const {
  const Tracer::Corners at = corners(triangle);
  const DVec3 normal = exactNormal(at.a, at.b, at.c);
  const double length = glm::length(normal);
  const Vec3 unit = length > 0 ? Vec3(double(handedness_) / length * normal) : Vec3(0);
  const Triangle& t = mesh_->triangles[triangle];
  Plane plane{unit, planeError(at.a, at.b, at.c, unit), Vec3(0), isFlat(t)};
  if (plane.flat) plane.shadingNormal = shadingNormal(t, Vec3(1, 0, 0), facing(unit));
  return plane;
}

bool InstanceGeometry::isFlat(const Triangle& t) const {
  const auto& n = mesh_->normals;
  return n.empty() || (n[t.x] == n[t.y] && n[t.x] == n[t.z]);
}

void InstanceGeometry::flatten(const Instance& instance) {
  vertices_.reserve(mesh_->positions.size() + 1);
  for (const Vec3& p : mesh_->positions) {
    const Vec3 world(DVec3(instance.toWorld * DVec4(DVec3(p), 1.0)));
    const float reach = maxComponent(glm::abs(world));
    if (!(reach < kMaxDistance && isFinite(world)))
      fail("instance \"{}\" reaches {:g} m from the scene's middle; scale the scene below {:g} m",
           instance.name, reach, kMaxDistance);
    vertices_.push_back(world);
    bounds_.add(world);
  }
  vertices_.emplace_back(0);
}

Tracer::Corners InstanceGeometry::corners(uint32_t triangle) const {
  const Triangle& t = mesh_->triangles[triangle];
  return {vertices_[t.x], vertices_[t.y], vertices_[t.z]};
}

void InstanceGeometry::surface(uint32_t triangle, float u, float v, SurfacePoint& p) const {
  const Triangle& t = mesh_->triangles[triangle];
  const Tracer::Corners at = corners(triangle);
  const Vec3 weights = clampedWeights(u, v);
  p.triangle = triangle, p.u = weights.y, p.v = weights.z;
  p.material = mesh_->material;
  p.position = pointOnTriangle(at.a, at.b, at.c, weights.y, weights.z);
  const Plane& plane = planes_[triangle];
  p.geometricNormal = facing(plane.normal);
  p.error = storageError(p.position, p.geometricNormal) + plane.error;
  setTexture(t, weights, p);
  p.shadingNormal = plane.flat ? plane.shadingNormal : shadingNormal(t, weights, p.geometricNormal);
  if (tangents_) setTangent(t, at, weights, p);
}

void InstanceGeometry::setTexture(const Triangle& t, const Vec3& weights, SurfacePoint& p) const {
  p.uv0 = mesh_->uv0.empty() ? Vec2(0) : interpolate(mesh_->uv0, t, weights);
  p.uv1 = mesh_->uv1.empty() ? Vec2(0) : interpolate(mesh_->uv1, t, weights);
  if (!mesh_->colors.empty()) p.color = colorAt(*mesh_, t, weights.y, weights.z);
}

Vec3 InstanceGeometry::shadingNormal(const Triangle& t, const Vec3& weights,
                                     const Vec3& plane) const {
  if (mesh_->normals.empty()) return plane;
  const Vec3 n = unitOr(normalToWorld_ * interpolate(mesh_->normals, t, weights), plane);
  const float side = glm::dot(n, plane);
  return side > 0 ? n : side < 0 ? -n : plane;
}

// Texture coordinates grow downwards in the image and normal maps count upwards: the bitangent
// points to where t falls.
void InstanceGeometry::setTangent(const Triangle& t, const Tracer::Corners& at, const Vec3& weights,
                                  SurfacePoint& p) const {
  Vec3 along(0);
  p.tangentSign = 1;
  if (!mesh_->tangents.empty()) {
    along = directionToWorld_ * Vec3(interpolate(mesh_->tangents, t, weights));
    p.tangentSign = handedness_ * (mesh_->tangents[t.x].w < 0 ? -1.0f : 1.0f);
  } else if (!mesh_->uv0.empty()) {
    const UvGradient gradient = uvGradient(mesh_->uv0, t, at);
    along = gradient.alongS;
    const Vec3 right = glm::cross(p.shadingNormal, along);
    p.tangentSign = glm::dot(right, gradient.alongT) > 0 ? -1.0f : 1.0f;
  }
  along -= glm::dot(along, p.shadingNormal) * p.shadingNormal;
  p.tangent = unitOr(along, Basis(p.shadingNormal).tangent);
}

}  // namespace ninefold
