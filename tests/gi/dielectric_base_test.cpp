// What a dielectric scatters below its reflection: common/gi/light/shading.h, "Opaque".
#include <gtest/gtest.h>

#include "common/gi/light/shading.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

// Seen head-on.
Bsdf plastic(float base, float roughness) {
  Material m = testing::matte(Vec3(base));
  m.roughness = roughness, m.specular = 1;
  SceneBuilder b;
  b.quad(b.material(m), Vec3(-1, 0, 1), Vec3(2, 0, 0), Vec3(0, 0, -2));
  const Scene scene = b.build();
  SurfacePoint surface;
  surface.geometricNormal = surface.shadingNormal = Vec3(0, 1, 0);
  return Shader(scene).shade(surface, Vec3(0, 1, 0), {}).bsdf;
}

// 2 int_0^1 albedo(c) c dc
float meanReflected(const Bsdf& bsdf) {
  constexpr int kSteps = 400;
  float sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const float c = (static_cast<float>(i) + 0.5f) / kSteps;
    sum += 2 * c / kSteps * lobeAlbedo(bsdf, Lobe::reflection, c).x;
  }
  return sum;
}

// In a furnace, over all directions. By glTF's own sum, base (1 - F(v.h)) + reflection, the smooth
// ones would give back 4 % more than comes in, as F(v.h) is 0.0435 in the mean of all pairs of
// directions, and the mean of F is 0.0857.
TEST(DielectricBase, WhiteGivesBackAllThatComes) {
  for (const float roughness : {0.0f, 0.1f, 0.2f, 0.3f, 0.5f, 0.8f, 1.0f}) {
    const Bsdf white = plastic(1, roughness);
    EXPECT_NEAR(white.diffuse.x + meanReflected(white), 1, 3e-3) << roughness;
  }
}

TEST(DielectricBase, HasTheShareThatReflectionLeaves) {
  constexpr float kMeanSchlick = 0.04f + 0.96f / 21;  // smooth, index 1.5
  for (const float base : {0.0f, 0.2f, 0.5f, 0.8f}) {
    const Bsdf smooth = plastic(base, 0);
    EXPECT_NEAR(smooth.diffuse.x, base * (1 - kMeanSchlick), 1e-3) << base;
    EXPECT_NEAR(meanReflected(smooth), kMeanSchlick, 1e-3) << base;
  }
}

}  // namespace
}  // namespace ninefold
