// make_scene.h: small scenes built in code, so that a test shows what it measures.
#pragma once

#include "common/scene/reader.h"
#include "common/scene/scene.h"

namespace ninefold::testing {

inline Material matte(Vec3 albedo, Vec3 emission = Vec3(0)) {
  Material m;
  m.baseColor = albedo, m.emission = emission;
  m.metallic = 0, m.roughness = 1, m.specular = 0;
  return m;
}

inline Material glass(float ior) {
  Material m;
  m.metallic = 0, m.roughness = 0, m.transmission = 1, m.ior = ior, m.solid = true;
  return m;
}

inline Material mirror(Vec3 f0 = Vec3(1)) {
  Material m;
  m.baseColor = f0, m.metallic = 1, m.roughness = 0;
  return m;
}

class SceneBuilder {
 public:
  int material(const Material& m) {
    scene_.materials.push_back(m);
    return static_cast<int>(scene_.materials.size()) - 1;
  }
  // Quadrilateral origin, origin + u, origin + u + v, origin + v; the front looks along cross(u,
  // v).
  SceneBuilder& quad(int material, Vec3 origin, Vec3 u, Vec3 v) {
    Mesh mesh;
    mesh.positions = {origin, origin + u, origin + u + v, origin + v};
    mesh.triangles = {Triangle(0, 1, 2), Triangle(0, 2, 3)};
    return add(std::move(mesh), material);
  }
  // Axis-aligned box; fronts look inwards (a room) or outwards (a thing).
  SceneBuilder& box(int material, Vec3 low, Vec3 high, bool inwards) {
    Mesh mesh;
    for (int i = 0; i < 8; ++i)
      mesh.positions.push_back(Vec3((i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y,
                                    (i & 4) != 0 ? high.z : low.z));
    const uint32_t outward[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                    {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (const auto& f : outward) {
      const uint32_t b = inwards ? f[3] : f[1], d = inwards ? f[1] : f[3];
      mesh.triangles.push_back(Triangle(f[0], b, f[2]));
      mesh.triangles.push_back(Triangle(f[0], f[2], d));
    }
    return add(std::move(mesh), material);
  }
  // Sphere of rings x 2 rings quads with exact normals; the front looks outwards.
  SceneBuilder& sphere(int material, Vec3 centre, float radius, int rings, bool inwards = false) {
    Mesh mesh;
    const int columns = 2 * rings;
    for (int r = 0; r <= rings; ++r)
      for (int c = 0; c <= columns; ++c) {
        const float theta = kPi * static_cast<float>(r) / static_cast<float>(rings);
        const float phi = 2 * kPi * static_cast<float>(c) / static_cast<float>(columns);
        const Vec3 n(std::sin(theta) * std::cos(phi), std::cos(theta),
                     -std::sin(theta) * std::sin(phi));
        mesh.positions.push_back(centre + radius * n);
        mesh.normals.push_back(inwards ? -n : n);
      }
    const auto at = [&](int r, int c) { return static_cast<uint32_t>(r * (columns + 1) + c); };
    for (int r = 0; r < rings; ++r)
      for (int c = 0; c < columns; ++c) {
        Triangle lower(at(r, c), at(r + 1, c), at(r + 1, c + 1));
        Triangle upper(at(r, c), at(r + 1, c + 1), at(r, c + 1));
        if (inwards) std::swap(lower.y, lower.z), std::swap(upper.y, upper.z);
        if (r + 1 < rings) mesh.triangles.push_back(lower);
        if (r > 0) mesh.triangles.push_back(upper);
      }
    return add(std::move(mesh), material);
  }
  SceneBuilder& light(const PunctualLight& l) {
    scene_.lights.push_back(l);
    return *this;
  }
  // A goniometric light whose f is value(theta, phi), in degrees.
  template <typename Value>
  SceneBuilder& goniometric(PunctualLight light, std::vector<float> vertical,
                            std::vector<float> horizontal, Value value) {
    LightProfile p{"profile", std::move(vertical), std::move(horizontal), {}};
    for (const float theta : p.vertical)
      for (const float phi : p.horizontal) p.values.push_back(value(theta, phi));
    light.kind = LightKind::goniometric;
    light.profile = static_cast<int>(scene_.profiles.size());
    light.across = acrossAxis(light.direction, light.across);
    scene_.profiles.push_back(std::move(p));
    return this->light(light);
  }
  SceneBuilder& environment(Radiance l) {
    scene_.environment = l;
    return *this;
  }
  SceneBuilder& camera(Vec3 eye, Vec3 target, float fov = 0.8f, Vec3 up = Vec3(0, 1, 0)) {
    Camera c;
    c.name = "test", c.eye = eye, c.forward = glm::normalize(target - eye), c.up = up,
    c.verticalFov = fov;
    scene_.cameras = {c};
    return *this;
  }
  Scene build() {
    for (const Mesh& mesh : scene_.meshes)
      for (const Vec3& p : mesh.positions) scene_.bounds.add(p);
    if (scene_.cameras.empty()) camera(Vec3(0), Vec3(0, 0, -1));
    validate(scene_);
    return scene_;
  }

 private:
  SceneBuilder& add(Mesh mesh, int material) {
    mesh.material = material;
    Instance instance;
    instance.mesh = static_cast<int>(scene_.meshes.size());
    instance.node = static_cast<int>(scene_.instances.size());
    scene_.meshes.push_back(std::move(mesh));
    scene_.instances.push_back(instance);
    return *this;
  }
  Scene scene_;
};

}  // namespace ninefold::testing
