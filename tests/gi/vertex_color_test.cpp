// Colours of vertices multiply the material's colour and opacity. A matte square under an
// environment of radiance 1 shows its albedo; a blended one of opacity a in front of a black ground
// shows a times its albedo, and the environment passes where it is clear.
#include <gtest/gtest.h>

#include "common/scene/needs.h"
#include "tests/gi/expect.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

// A square that fills the picture, seen from straight above, with a colour at each corner.
Scene square(const Material& material, std::vector<Vec4> colors) {
  SceneBuilder b;
  b.quad(b.material(material), Vec3(-1, -1, 0), Vec3(2, 0, 0), Vec3(0, 2, 0));
  b.environment(Radiance(1)).camera(Vec3(0, 0, 2), Vec3(0), 0.8f);
  Scene scene = b.build();
  scene.meshes[0].colors = std::move(colors);
  validate(scene);
  return scene;
}

std::vector<Vec4> everywhere(Vec4 color) { return std::vector<Vec4>(4, color); }

void expectShown(const Scene& scene, Vec3 expected, float tolerance = 0.01f) {
  const Tracer tracer(scene, Isa::automatic);
  for (const testing::Estimator& e : testing::estimators()) {
    const Vec3 mean = testing::render(tracer, e.settings, 64).mean();
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c], expected[c], tolerance) << e.name << " " << c;
  }
}

TEST(VertexColor, IsTheAlbedoOfAWhiteMaterialAndMultipliesAnother) {
  const Vec4 color(0.8f, 0.2f, 0.1f, 1);
  expectShown(square(testing::matte(Vec3(1)), everywhere(color)), Vec3(color));
  const Vec3 base(0.5f, 1, 0.3f);
  expectShown(square(testing::matte(base), everywhere(color)), base * Vec3(color));
}

TEST(VertexColor, IsTheSameBitsAsAColourOfTheMaterial) {
  const Vec4 color(0.8f, 0.2f, 0.1f, 1);
  const Scene painted = square(testing::matte(Vec3(1)), everywhere(color));
  const Scene plain = square(testing::matte(Vec3(color)), {});
  const Tracer a(painted, Isa::automatic), b(plain, Isa::automatic);
  for (const testing::Estimator& e : testing::estimators())
    EXPECT_EQ(testing::render(a, e.settings, 2).pixels, testing::render(b, e.settings, 2).pixels)
        << e.name;
}

// Red grows from left to right, so the mean over the middle of the square is a half, and the left
// half of the picture is darker than the right one by the distance of their centres.
TEST(VertexColor, IsInterpolatedLinearly) {
  const Vec4 left(0, 0.5f, 0.5f, 1), right(1, 0.5f, 0.5f, 1);
  const Scene scene = square(testing::matte(Vec3(1)), {left, right, right, left});
  const Tracer tracer(scene, Isa::automatic);
  const float halfWidth = 2 * std::tan(0.4f);  // of what the picture shows [m]
  for (const testing::Estimator& e : testing::estimators(16)) {
    const testing::Rendered image = testing::render(tracer, e.settings, 64);
    for (size_t x = 0; x < 16; ++x) {
      double sum = 0;
      for (size_t y = 0; y < 16; ++y) sum += static_cast<double>(image.pixels[16 * y + x].x) / 16;
      const double place = (2 * (static_cast<double>(x) + 0.5) / 16 - 1) * halfWidth;
      EXPECT_NEAR(sum, 0.5 + 0.5 * place, 0.02) << e.name << " " << x;
    }
  }
}

TEST(VertexColor, AlphaBlendsWhereTheMaterialDoes) {
  const Vec4 color(0.8f, 0.2f, 0.1f, 0.25f);
  Material m = testing::matte(Vec3(1));
  expectShown(square(m, everywhere(color)), Vec3(color));  // opaque: alpha does not count
  EXPECT_FALSE(needsOf(square(m, everywhere(color)), Radiance(1)).transmission);
  m.alphaMode = AlphaMode::blend;
  const Scene scene = square(m, everywhere(color));
  EXPECT_TRUE(needsOf(scene, Radiance(1)).transmission);
  expectShown(scene, 0.25f * Vec3(color) + Vec3(0.75f));
}

TEST(VertexColor, AlphaCutsHolesIntoAMask) {
  Material m = testing::matte(Vec3(0));
  m.alphaMode = AlphaMode::mask, m.alphaCutoff = 0.5f;
  expectShown(square(m, everywhere(Vec4(1, 1, 1, 0.6f))), Vec3(0));
  expectShown(square(m, everywhere(Vec4(1, 1, 1, 0.4f))), Vec3(1));
}

// A lamp that is cut away emits nothing.
TEST(VertexColor, AlphaCutsHolesIntoALamp) {
  for (const float alpha : {0.4f, 0.6f}) {
    Material lamp = testing::matte(Vec3(0), Vec3(3));
    lamp.alphaMode = AlphaMode::mask, lamp.alphaCutoff = 0.5f;
    Scene scene = square(lamp, everywhere(Vec4(1, 1, 1, alpha)));
    scene.environment = Radiance(0);
    const Emitters emitters(scene, Radiance(0));
    const Radiance shown = emitters.pointAt(0, Vec2(0.3f)).radiance;
    EXPECT_EQ(shown, Radiance(alpha < 0.5f ? 0.0f : 3.0f));
    EXPECT_EQ(isBlack(emitters[0].flux), alpha < 0.5f);
  }
}

}  // namespace
}  // namespace ninefold
