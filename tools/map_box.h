// map_box.h: a room like that of Jozwowski 2002, 5: two boxes stand in it, and a point light, which
// nobody sees, goes round on a circle.
//
//   surfaces    16: six walls and twice five faces; each cut into n x n, so 64, 256, 1024, ...
//   colours     as his: blue behind the boxes, red behind the camera, else white
//   lamp(i)     c + r (cos a, 0, sin a),  a = 2 pi i/kTurn       i: frame
//
// His lamp's circle and sizes are not told; these are ours. A surface is two triangles.
//
// Threads: plain values.   Errors: none; the scene is valid.
#pragma once

#include <array>

#include "common/scene/reader.h"
#include "common/scene/scene.h"

namespace ninefold {

inline constexpr int kBoxSurfaces = 16;
inline constexpr int kTurn = 100;  // frames that the lamp needs for its circle

inline Vec3 lampOnCircle(int frame) {
  constexpr Metres kRadius = 1.2f, kHeight = 0.9f;
  const float a = 2 * kPi * static_cast<float>(frame) / static_cast<float>(kTurn);
  return Vec3(kRadius * std::cos(a), kHeight, kRadius * std::sin(a));
}

class MapBox {
 public:
  // cuts: n. The lamp is where it is in frame 0.
  static Scene make(int cuts) {
    MapBox box(cuts);
    box.room();
    box.thing(Vec3(-0.7f, -1.5f, -0.7f), 0.5f, 1.6f, 0.3f);
    box.thing(Vec3(0.8f, -1.5f, 0.2f), 0.45f, 0.9f, -0.4f);
    return box.finished();
  }

 private:
  enum Colour : int { kWhite, kBlue, kRed, kColours };

  explicit MapBox(int cuts) : cuts_(cuts) {
    scene_.name = "box";
    for (const Vec3 albedo :
         {Vec3(0.7f, 0.7f, 0.7f), Vec3(0.2f, 0.3f, 0.7f), Vec3(0.7f, 0.2f, 0.15f)}) {
      Material matte;
      matte.baseColor = albedo, matte.metallic = 0, matte.specular = 0;
      scene_.materials.push_back(matte);
    }
    for (int colour = 0; colour < kColours; ++colour)
      meshes_[static_cast<size_t>(colour)].material = colour;
  }

  // A surface, cut into cuts x cuts; its front looks along cross(u, v).
  void surface(Colour colour, Vec3 origin, Vec3 u, Vec3 v) {
    Mesh& mesh = meshes_[colour];
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    const auto row = static_cast<uint32_t>(cuts_) + 1;
    const float step = 1 / static_cast<float>(cuts_);
    for (int j = 0; j <= cuts_; ++j)
      for (int i = 0; i <= cuts_; ++i)
        mesh.positions.push_back(origin + static_cast<float>(i) * step * u +
                                 static_cast<float>(j) * step * v);
    for (uint32_t j = 0; j + 1 < row; ++j)
      for (uint32_t i = 0; i + 1 < row; ++i) {
        const uint32_t a = first + i + row * j;
        mesh.triangles.push_back(Triangle(a, a + 1, a + row + 1));
        mesh.triangles.push_back(Triangle(a, a + row + 1, a + row));
      }
  }

  void room() {
    const Vec3 x(4, 0, 0), y(0, 3, 0), z(0, 0, 4);
    surface(kWhite, Vec3(-2, -1.5f, 2), x, -z);
    surface(kWhite, Vec3(-2, 1.5f, -2), x, z);
    surface(kBlue, Vec3(-2, -1.5f, -2), x, y);
    surface(kRed, Vec3(2, -1.5f, 2), -x, y);
    surface(kWhite, Vec3(-2, -1.5f, 2), -z, y);
    surface(kWhite, Vec3(2, -1.5f, -2), z, y);
  }

  // A box on the floor, without the face that it stands on. foot: the middle of that.
  void thing(Vec3 foot, Metres half, Metres height, float turn) {
    const Vec3 a = half * Vec3(std::cos(turn), 0, -std::sin(turn));
    const Vec3 b = half * Vec3(std::sin(turn), 0, std::cos(turn));
    const Vec3 up(0, height, 0);
    surface(kWhite, foot - a - b + up, 2.0f * b, 2.0f * a);
    surface(kWhite, foot - a + b, 2.0f * a, up);
    surface(kWhite, foot + a - b, -2.0f * a, up);
    surface(kWhite, foot + a + b, -2.0f * b, up);
    surface(kWhite, foot - a - b, 2.0f * b, up);
  }

  Scene finished() {
    for (Mesh& mesh : meshes_) {
      for (const Vec3& p : mesh.positions) scene_.bounds.add(p);
      Instance instance;
      instance.mesh = instance.node = static_cast<int>(scene_.instances.size());
      scene_.meshes.push_back(std::move(mesh));
      scene_.instances.push_back(instance);
    }
    PunctualLight lamp;
    lamp.position = lampOnCircle(0), lamp.intensity = Vec3(2);
    scene_.lights.push_back(lamp);
    Camera camera;
    camera.name = "box", camera.eye = Vec3(0, 0.2f, 1.95f);
    camera.forward = glm::normalize(Vec3(0, -0.12f, -1)), camera.verticalFov = 1.2f;
    scene_.cameras = {camera};
    validate(scene_);
    return std::move(scene_);
  }

  int cuts_;
  Scene scene_;
  std::array<Mesh, kColours> meshes_;
};

}  // namespace ninefold
