#include "common/gi/selective/visual_masking.h"

#include <cmath>

#include "common/sampling/distribution.h"
#include "common/sampling/sampler.h"
#include "common/scene/texture.h"

namespace ninefold {
namespace {

constexpr uint32_t kSquares = 64;  // that are looked at
constexpr uint32_t kTexels = 64;   // of each, anywhere in it: a grid would agree with some patterns
constexpr double kSeen = 0.01;     // c_0

double elevationOf(double contrast) {
  static const double k1 = std::pow(6.0, -7 / 3.0), k2 = std::pow(6.0, 10 / 3.0);
  const double masked = k1 * std::pow(k2 * contrast / kSeen, 0.7);
  return std::pow(1 + std::pow(masked, 4), 0.25);
}

float number(uint64_t of, uint32_t i) {
  return unitFloat(static_cast<uint32_t>(hashWords(of, i) >> 32));
}

// The texture of one instance.
class Textured {
 public:
  Textured(const Scene& scene, const Mesh& mesh, const DMat3& linear, Metres h)
      : scene_(scene),
        mesh_(mesh),
        use_(scene.materials[static_cast<size_t>(mesh.material)].baseColorMap),
        uv_(use_.uvSet == 0 ? mesh.uv0 : mesh.uv1),
        linear_(linear),
        h_(h) {}

  double contrast() const {
    std::vector<float> areas;
    for (const Triangle& t : mesh_.triangles) areas.push_back(areaOf(t));
    const Distribution byArea(areas);
    if (byArea.empty()) return 0;
    double sum = 0, squares = 0;
    for (uint32_t i = 0; i < kSquares; ++i) {
      const uint32_t triangle = byArea.choose(number(1, i)).index;
      const double mean = squareAt(mesh_.triangles[triangle], areas[triangle], i);
      sum += mean, squares += mean * mean;
    }
    const double mean = sum / kSquares;
    return mean > 0 ? std::sqrt(std::max(squares / kSquares - mean * mean, 0.0)) / mean : 0;
  }

 private:
  Vec3 corner(uint32_t vertex) const { return Vec3(linear_ * DVec3(mesh_.positions[vertex])); }
  float areaOf(const Triangle& t) const {
    return 0.5f * glm::length(glm::cross(corner(t.y) - corner(t.x), corner(t.z) - corner(t.x)));
  }
  // Mean luminance of a square of side h somewhere on a triangle.
  double squareAt(const Triangle& t, float area, uint32_t i) const {
    const Vec2 a = uv_[t.x], b = uv_[t.y] - a, c = uv_[t.z] - a;
    const float areaInTexture = 0.5f * std::abs(b.x * c.y - b.y * c.x);
    const float side = h_ * std::sqrt(areaInTexture / area);
    float u = number(2, i), v = number(3, i);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const Vec2 middle = a + u * b + v * c;
    double sum = 0;
    for (uint32_t k = 0; k < kTexels; ++k) {
      const uint32_t n = kTexels * i + k;
      const Vec2 at = middle + side * Vec2(number(4, n) - 0.5f, number(5, n) - 0.5f);
      const Vec4 texel = lookUp(scene_, use_, at, at);
      sum += static_cast<double>(0.2126f * texel.x + 0.7152f * texel.y + 0.0722f * texel.z);
    }
    return sum / kTexels;
  }

  const Scene& scene_;
  const Mesh& mesh_;
  const TextureUse& use_;
  const std::vector<Vec2>& uv_;
  const DMat3 linear_;
  const Metres h_;
};

}  // namespace

VisualMasking::VisualMasking(const Scene& scene, Metres h, const VisualMasking* before) : h_(h) {
  if (before != nullptr && before->known_.size() != scene.instances.size()) before = nullptr;
  for (size_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
    const DMat3 linear(instance.toWorld);
    if (before != nullptr && before->h_ == h && before->known_[i].linear == linear &&
        before->known_[i].shape == mesh.shape) {
      known_.push_back(before->known_[i]);
      continue;
    }
    const TextureUse& use = scene.materials[static_cast<size_t>(mesh.material)].baseColorMap;
    const bool hasTexture = use && !(use.uvSet == 0 ? mesh.uv0 : mesh.uv1).empty();
    const double contrast = hasTexture ? Textured(scene, mesh, linear, h).contrast() : 0;
    known_.push_back({linear, mesh.shape, static_cast<float>(elevationOf(contrast))});
  }
}

}  // namespace ninefold
