// Sheen and clear coats in pictures, by every method: each path of light over them is counted once.
#include "common/bsdf/bsdf.h"
#include "tests/bsdf/materials.h"
#include "tests/gi/expect.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

SceneBuilder furnace() {
  SceneBuilder b;
  b.box(b.material(testing::matte(Vec3(0), Vec3(1))), Vec3(-1), Vec3(1), true);
  return b;
}

// A smooth coat over a perfect mirror keeps from it what it reflects itself.
TEST(Layers, ACoatedMirrorIsInvisibleInAFurnace) {
  Material varnished = testing::mirror();
  varnished.coat = 1;
  SceneBuilder b = furnace();
  b.sphere(b.material(varnished), Vec3(0), 0.5f, 64);
  b.camera(Vec3(0, 0, 0.95f), Vec3(0.05f, 0.02f, -0.3f), 1.0f);
  testing::expectRadiance(b.build(), testing::estimators(12), 1, {.frames = 32, .bias = 2e-3},
                          "coat");
}

// A surface that reflects by its sheen alone shows its albedo.
TEST(Layers, SheenShowsItsAlbedoInAFurnace) {
  Material velvet = testing::matte(Vec3(0));
  velvet.sheenColor = Vec3(0.8f), velvet.sheenRoughness = 0.5f;
  SceneBuilder b = furnace();
  b.quad(b.material(velvet), Vec3(-0.9f, 0, 0.9f), Vec3(1.8f, 0, 0), Vec3(0, 0, -1.8f));
  const float cosine = 0.3f;  // of the direction from the middle to the eye
  b.camera(0.5f * Vec3(0, cosine, std::sqrt(1 - cosine * cosine)), Vec3(0), 0.01f);
  const float albedo =
      sampledAlbedo(cloth(0.25f, Vec3(0.8f)), Lobe::reflection, upward(cosine), 128).x;
  testing::expectRadiance(b.build(), testing::estimators(8), double(albedo),
                          {.frames = 64, .bias = 5e-3, .error = 0.02}, "sheen");
}

// A room with a coated floor, coated metal and cloth, as the path tracer sees it. Light comes to
// the wall from all of them. Biased methods may be 7 % off.
TEST(Layers, ARoomOfThemAgreesWithThePathTracer) {
  Material floor = testing::matte(Vec3(0.6f, 0.4f, 0.3f)), car = testing::matte(Vec3(0.7f));
  floor.coat = 0.8f, floor.coatRoughness = 0.3f;
  car.metallic = 1, car.roughness = 0.5f, car.specular = 1, car.coat = 1, car.coatRoughness = 0.25f;
  Material cloth = testing::matte(Vec3(0.3f));
  cloth.sheenColor = Vec3(0.9f), cloth.sheenRoughness = 0.4f;
  SceneBuilder b;
  b.box(b.material(testing::matte(Vec3(0.6f))), Vec3(-1), Vec3(1), true);
  b.quad(b.material(testing::matte(Vec3(0), Vec3(10))), Vec3(-0.3f, 0.99f, -0.3f), Vec3(0.6f, 0, 0),
         Vec3(0, 0, 0.6f));
  b.quad(b.material(floor), Vec3(-0.99f, -0.99f, 0.99f), Vec3(1.98f, 0, 0), Vec3(0, 0, -1.98f));
  b.box(b.material(car), Vec3(-0.7f, -0.98f, -0.6f), Vec3(-0.1f, -0.5f, -0.2f), false);
  b.sphere(b.material(cloth), Vec3(0.4f, -0.6f, -0.3f), 0.35f, 24);
  b.camera(Vec3(0, 0, 0.95f), Vec3(0, -0.5f, -0.4f), 0.8f);
  const Scene scene = b.build();
  const Tracer tracer(scene, Isa::automatic);
  const auto reference = testing::render(tracer, testing::reference().settings, 256);
  for (testing::Estimator& e : testing::othersThanReference()) {
    e.settings.photonRadius = Settings{}.photonRadius;
    const auto image = testing::render(tracer, e.settings, 128);
    const double bias = e.facts().bias != nullptr ? 0.07 : 5e-3;
    EXPECT_NEAR(image.grey(), reference.grey(),
                4 * std::hypot(image.error(), reference.error()) + bias * reference.grey())
        << e.name;
    EXPECT_LT(std::hypot(image.error(), reference.error()), 0.03 * reference.grey()) << e.name;
  }
}

// What lies over a surface decides who brings its light.
TEST(Layers, SheenIsForVplsAndCoatsAreForPhotons) {
  const auto needsWith = [](const Material& m) {
    SceneBuilder b;
    b.quad(b.material(m), Vec3(-1, 0, 1), Vec3(2, 0, 0), Vec3(0, 0, -2));
    return needsOf(b.build(), Radiance(0));
  };
  Material velvet = testing::matte(Vec3(0.5f)), varnished = velvet, plain = velvet;
  velvet.sheenColor = Vec3(0.5f), varnished.coat = 1;
  EXPECT_FALSE(needsWith(plain).reflection);
  EXPECT_TRUE(needsWith(velvet).glossy && !needsWith(velvet).caustics);
  EXPECT_TRUE(needsWith(varnished).caustics && !needsWith(varnished).glossy);
  EXPECT_TRUE(needsWith(varnished).smoothSpecular && !needsWith(varnished).roughSpecular);
  varnished.coatRoughness = 0.3f;
  EXPECT_TRUE(needsWith(varnished).roughSpecular && !needsWith(varnished).smoothSpecular);
}

// The weights of D and of layers add up to what comes in, over all directions.
TEST(Layers, CoatedWhiteGivesBackWhatItGets) {
  Material white = testing::matte(Vec3(1));
  white.coat = 1;
  SceneBuilder b;
  b.quad(b.material(white), Vec3(-1, 0, 1), Vec3(2, 0, 0), Vec3(0, 0, -2));
  const Scene scene = b.build();
  const Tracer tracer(scene, Isa::automatic);
  const Shader shader(scene);
  const SurfacePoint s = tracer.surface(tracer.closest(Vec3(0, 1, 0), Vec3(0, -1, 0), 10));
  double all = 0;
  constexpr int kSteps = 200;
  for (int i = 0; i < kSteps; ++i) {
    const float cosine = std::sqrt((static_cast<float>(i) + 0.5f) / kSteps);
    const Vec3 wo(std::sqrt(1 - cosine * cosine), cosine, 0);
    const Bsdf bsdf = shader.shade(s, wo, {}).bsdf;
    all += double(bsdf.diffuse.x + lobeAlbedo(bsdf, Lobe::reflection, cosine).x) / kSteps;
  }
  EXPECT_NEAR(all, 1, 5e-3);
}

}  // namespace
}  // namespace ninefold
