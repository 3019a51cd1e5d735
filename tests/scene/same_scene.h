// same_scene.h: expects that two scenes have the same values, those that were multiplied to an ulp
// or two. Materials may be in another order.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <tuple>

#include "common/scene/scene.h"

namespace ninefold {

inline const Material& named(const Scene& scene, const std::string& name) {
  const auto found = std::ranges::find(scene.materials, name, &Material::name);
  EXPECT_NE(found, scene.materials.end()) << name;
  return *found;
}

inline void expectNear(Vec3 a, Vec3 b, float ulps = 2) {
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(a[i], b[i], ulps * 1.2e-7f * std::max(1e-30f, std::abs(a[i])));
}

inline void expectSameUse(const Scene& a, const TextureUse& ua, const Scene& b,
                          const TextureUse& ub) {
  ASSERT_EQ(bool(ua), bool(ub));
  if (!ua) return;
  const TextureImage& ia = a.images[static_cast<size_t>(ua.image)];
  const TextureImage& ib = b.images[static_cast<size_t>(ub.image)];
  EXPECT_EQ(ia.texels, ib.texels);
  EXPECT_EQ(ia.srgb, ib.srgb);
  EXPECT_EQ(std::tuple(ua.uvSet, ua.offset, ua.scale, ua.rotation, ua.wrapS, ua.wrapT, ua.nearest),
            std::tuple(ub.uvSet, ub.offset, ub.scale, ub.rotation, ub.wrapS, ub.wrapT, ub.nearest));
}

inline void expectSameMaterial(const Scene& a, const Material& ma, const Scene& b,
                               const Material& mb) {
  EXPECT_EQ(std::tuple(ma.baseColor, ma.opacity, ma.alphaMode, ma.alphaCutoff, ma.metallic,
                       ma.roughness, ma.normalScale, ma.doubleSided),
            std::tuple(mb.baseColor, mb.opacity, mb.alphaMode, mb.alphaCutoff, mb.metallic,
                       mb.roughness, mb.normalScale, mb.doubleSided));
  EXPECT_EQ(std::tuple(ma.transmission, ma.ior, ma.specular, ma.specularColor, ma.solid,
                       ma.attenuationColor, ma.attenuationDistance),
            std::tuple(mb.transmission, mb.ior, mb.specular, mb.specularColor, mb.solid,
                       mb.attenuationColor, mb.attenuationDistance));
  EXPECT_EQ(std::tuple(ma.sheenColor, ma.sheenRoughness, ma.coat, ma.coatRoughness),
            std::tuple(mb.sheenColor, mb.sheenRoughness, mb.coat, mb.coatRoughness));
  expectSameUse(a, ma.coatMap, b, mb.coatMap);
  expectSameUse(a, ma.sheenColorMap, b, mb.sheenColorMap);
  expectNear(ma.emission, mb.emission);
  expectSameUse(a, ma.baseColorMap, b, mb.baseColorMap);
  expectSameUse(a, ma.metallicRoughnessMap, b, mb.metallicRoughnessMap);
  expectSameUse(a, ma.normalMap, b, mb.normalMap);
  expectSameUse(a, ma.emissionMap, b, mb.emissionMap);
}

inline void expectSameScene(const Scene& a, const Scene& b) {
  ASSERT_EQ(a.instances.size(), b.instances.size());
  const float size = a.bounds.radius();
  for (size_t i = 0; i < a.instances.size(); ++i) {
    const Instance &ia = a.instances[i], &ib = b.instances[i];
    EXPECT_EQ(ia.name, ib.name);
    const Mesh& ma = a.meshes[static_cast<size_t>(ia.mesh)];
    const Mesh& mb = b.meshes[static_cast<size_t>(ib.mesh)];
    EXPECT_EQ(ma.positions, mb.positions);
    EXPECT_EQ(ma.triangles, mb.triangles);
    EXPECT_EQ(ma.uv0, mb.uv0);
    EXPECT_EQ(ma.normals.size(), mb.normals.size());
    for (int c = 0; c < 3; ++c) EXPECT_EQ(ia.toWorld[c], ib.toWorld[c]);
    const DVec3 pa = DVec3(ia.toWorld[3]) + a.origin, pb = DVec3(ib.toWorld[3]) + b.origin;
    EXPECT_NEAR(glm::length(pa - pb), 0, 1e-12 * double(size));
    const Material& one = a.materials[static_cast<size_t>(ma.material)];
    expectSameMaterial(a, one, b, named(b, one.name));
  }
  ASSERT_EQ(a.cameras.size(), b.cameras.size());
  for (size_t i = 0; i < a.cameras.size(); ++i) {
    EXPECT_NEAR(glm::length(a.cameras[i].forward - b.cameras[i].forward), 0, 1e-6f);
    EXPECT_NEAR(
        glm::length(DVec3(a.cameras[i].eye) + a.origin - DVec3(b.cameras[i].eye) - b.origin), 0,
        1e-6 * double(size));
    EXPECT_EQ(a.cameras[i].verticalFov, b.cameras[i].verticalFov);
    EXPECT_EQ(a.cameras[i].orthographicHeight, b.cameras[i].orthographicHeight);
  }
  ASSERT_EQ(a.lights.size(), b.lights.size());
  for (size_t i = 0; i < a.lights.size(); ++i) {
    EXPECT_EQ(a.lights[i].kind, b.lights[i].kind);
    expectNear(a.lights[i].intensity, b.lights[i].intensity);
    EXPECT_NEAR(glm::length(a.lights[i].direction - b.lights[i].direction), 0, 1e-6f);
    EXPECT_NEAR(glm::length(DVec3(a.lights[i].position) + a.origin - DVec3(b.lights[i].position) -
                            b.origin),
                0, 1e-6 * double(size));
  }
}

}  // namespace ninefold
