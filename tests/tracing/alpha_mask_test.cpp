// Texels below the cutoff are not there, for every kind of ray.
#include <gtest/gtest.h>

#include "common/tracing/tracer.h"
#include "tests/tracing/make_scene.h"

namespace ninefold {
namespace {

// A square whose image is a checkerboard of opaque and clear texels, in front of a solid one.
Scene checkeredScreen(int side) {
  Scene scene = sceneOf({square(), square()});
  scene.instances[1].toWorld[3] = DVec4(0, 0, -1, 1);
  scene.materials.resize(2);
  scene.meshes[1].material = 1;
  TextureImage image{"checker", side, side, 4, false, {}};
  for (int i = 0; i < side * side; ++i) {
    const bool clear = (i % side + i / side) % 2 == 0;
    image.texels.insert(image.texels.end(), {255, 255, 255, uint8_t(clear ? 0 : 255)});
  }
  scene.images.push_back(image);
  scene.materials[0].alphaMode = AlphaMode::mask;
  scene.materials[0].baseColorMap.image = 0;
  scene.materials[0].baseColorMap.nearest = true;
  return scene;
}

TEST(AlphaMask, RaysPassThroughClearTexelsOnly) {
  constexpr int kSide = 8;
  const Scene scene = checkeredScreen(kSide);
  for (const Isa isa : {Isa::avx2, Isa::automatic}) {
    const Tracer tracer(scene, isa);
    for (int y = 0; y < kSide; ++y) {
      RayPacket rays, shadows;
      uint32_t expected = 0;
      for (int x = 0; x < kSide; ++x) {
        const Vec3 origin((2 * float(x) + 1) / kSide - 1, 1 - (2 * float(y) + 1) / kSide, 0.5f);
        rays.set(x, origin, {0, 0, -1}, 0, kFar);
        shadows.set(x, origin, {0, 0, -1}, 0, 1);
        const bool clear = (x + y) % 2 == 0;
        expected |= uint32_t(!clear) << x;
        EXPECT_EQ(tracer.closest(origin, {0, 0, -1}, kFar).instance, clear ? 1u : 0u);
        EXPECT_EQ(tracer.occluded(origin, {0, 0, -1}, 1), !clear);
      }
      Hit hits[kPacket];
      tracer.closest16(rays, 0xff, hits);
      for (int x = 0; x < kSide; ++x)
        EXPECT_EQ(hits[x].instance, (expected >> x & 1) != 0 ? 0u : 1u);
      EXPECT_EQ(tracer.occluded16(shadows, 0xff), expected);
    }
  }
}

TEST(AlphaMask, WithoutAMapTheOpacityDecidesForTheWholeMesh) {
  Scene scene = sceneOf({square()});
  scene.materials[0].alphaMode = AlphaMode::mask;
  for (const float opacity : {0.4f, 0.6f}) {
    scene.materials[0].opacity = opacity;
    EXPECT_EQ(Tracer(scene, Isa::automatic).occluded({0.1f, 0.2f, 1}, {0, 0, -1}, kFar),
              opacity > 0.5f);
  }
}

TEST(AlphaMask, BlendedAndOpaqueMaterialsStopEveryRay) {
  Scene scene = checkeredScreen(8);
  for (const AlphaMode mode : {AlphaMode::blend, AlphaMode::opaque}) {
    scene.materials[0].alphaMode = mode;
    const Tracer tracer(scene, Isa::automatic);
    EXPECT_EQ(tracer.closest({-0.9f, 0.9f, 0.5f}, {0, 0, -1}, kFar).instance, 0u);
  }
}

}  // namespace
}  // namespace ninefold
