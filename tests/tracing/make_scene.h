// make_scene.h: small scenes for the tests of tracing, and seeded random geometry.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "common/scene/scene.h"

namespace ninefold {

inline Mesh meshOf(std::vector<Vec3> positions, std::vector<Triangle> triangles) {
  Mesh mesh;
  mesh.positions = std::move(positions);
  mesh.triangles = std::move(triangles);
  return mesh;
}

// One instance per mesh, one grey material that asks for tangents (nothing here looks its map up).
inline Scene sceneOf(std::vector<Mesh> meshes) {
  Scene scene;
  scene.name = "test";
  scene.materials.resize(1);
  scene.materials[0].normalMap.image = 0;
  for (size_t i = 0; i < meshes.size(); ++i) scene.instances.push_back({"", int(i), int(i)});
  scene.meshes = std::move(meshes);
  return scene;
}

// A square of side 2 in z = 0 around the origin, front towards +z, with texture coordinates (0,0)
// top left.
inline Mesh square() {
  Mesh mesh = meshOf({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
  mesh.uv0 = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  return mesh;
}

// The cube [-1, 1]^3; fronts face outwards.
inline Mesh cube() {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.emplace_back((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
  return meshOf(corners, {{0, 2, 3},
                          {0, 3, 1},
                          {4, 5, 7},
                          {4, 7, 6},
                          {0, 1, 5},
                          {0, 5, 4},
                          {2, 6, 7},
                          {2, 7, 3},
                          {0, 4, 6},
                          {0, 6, 2},
                          {1, 3, 7},
                          {1, 7, 5}});
}

class Dice {
 public:
  explicit Dice(uint64_t seed) : engine_(seed) {}
  float uniform(float low, float high) {
    return low + (high - low) * (static_cast<float>(engine_() >> 40) * 0x1p-24f);
  }
  int below(int n) { return static_cast<int>(engine_() % static_cast<uint64_t>(n)); }
  // Log-uniform: every order of magnitude alike.
  float magnitude(float low, float high) {
    return std::exp(uniform(std::log(low), std::log(high)));
  }
  Vec3 inBox(float half) {
    return {uniform(-half, half), uniform(-half, half), uniform(-half, half)};
  }
  Vec3 direction() {
    const float z = uniform(-1, 1), phi = uniform(0, 6.2831853f), r = std::sqrt(1 - z * z);
    return {r * std::cos(phi), r * std::sin(phi), z};
  }

 private:
  std::mt19937_64 engine_;
};

inline Mesh randomTriangles(Dice& dice, int count, float half, float size) {
  Mesh mesh;
  for (int i = 0; i < count; ++i) {
    const Vec3 at = dice.inBox(half);
    for (int corner = 0; corner < 3; ++corner) mesh.positions.push_back(at + dice.inBox(size));
    const auto first = static_cast<uint32_t>(3 * i);
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  return mesh;
}

inline constexpr float kFar = 1e30f;

}  // namespace ninefold
