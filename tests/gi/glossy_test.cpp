// Light by way of a glossy floor: rough metal, not so rough that it counts as diffuse. Photons have
// no part in it, so the blur of their radius must not show.
//
// E at x above a floor that a spot lights, one bounce, is an integral over the floor:
//
//   E = int I(w) cos_l/d_l^2  f(l, v)  cos_y cos_x/d^2 dA          [W/m^2]
//
// done here by a fine midpoint rule with the lobe of common/bsdf, which has tests of its own.
#include "common/bsdf/bsdf.h"
#include "common/scene/emitters.h"
#include "tests/gi/expect.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

constexpr float kAlbedo = 0.5f, kRoughness = 0.5f;
constexpr float kHalf = 0.02f;  // half the side of a plate over the floor [m]

Material glossyMetal(float metallic = 1) {
  Material m = testing::matte(Vec3(0.8f));
  m.metallic = metallic, m.roughness = kRoughness, m.specular = 1;
  return m;
}

PunctualLight spotAt(Vec3 position, Vec3 direction) {
  PunctualLight spot;
  spot.kind = LightKind::spot, spot.position = position, spot.direction = direction;
  spot.intensity = Vec3(1), spot.innerCone = 0.4f, spot.outerCone = 0.6f;
  return spot;
}

// E at the middle x of the plate, which looks down, from the floor y = 0 within 1 m of the middle.
double irradianceFromFloor(const PunctualLight& spot, Vec3 x) {
  const Scene noProfiles;
  Bsdf metal;
  metal.f0 = Vec3(0.8f), metal.alpha = kRoughness * kRoughness, metal.reflects = true;
  const auto local = [](Vec3 w) { return Vec3(w.x, w.z, w.y); };
  constexpr int kSteps = 800;
  const float cell = 2.0f / kSteps;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const Vec3 y((float(i) + 0.5f) * cell - 1, 0, (float(j) + 0.5f) * cell - 1);
      const Vec3 toLight = spot.position - y, toX = x - y;
      const Vec3 l = glm::normalize(toLight), v = glm::normalize(toX);
      const float arrives =
          Emitters::intensity(noProfiles, spot, -l).x / glm::dot(toLight, toLight);
      const Vec3 passes = y + x.y / spot.position.y * toLight - x;
      const bool shadow = std::abs(passes.x) < kHalf && std::abs(passes.z) < kHalf;
      if (arrives <= 0 || shadow) continue;
      const float scattered = evaluateLobe(metal, Lobe::reflection, local(v), local(l)).value.x;
      sum += double(arrives * scattered * v.y * v.y / glm::dot(toX, toX));
    }
  return sum * double(cell) * double(cell);
}

// The floor, and a small plate that looks down from x, seen from below.
SceneBuilder plateOverFloor(Vec3 x, const PunctualLight& spot) {
  SceneBuilder b;
  b.quad(b.material(glossyMetal()), Vec3(-1, 0, 1), Vec3(2, 0, 0), Vec3(0, 0, -2));
  b.quad(b.material(testing::matte(Vec3(kAlbedo))), x - Vec3(kHalf, 0, kHalf),
         Vec3(2 * kHalf, 0, 0), Vec3(0, 0, 2 * kHalf));
  b.light(spot);
  b.camera(x - Vec3(0, 0.03f, 0), x, 0.05f, Vec3(0, 0, 1));
  return b;
}

constexpr testing::Tolerance kTolerance{.frames = 128, .bias = 5e-3, .error = 0.03};

// At some distance, and so near that G is bounded. The plate is a thousandth of the disks over
// which a pool's photons are counted, and only one ray in 32 tells how much of a disk there is:
// biased methods show it too dark.
TEST(Glossy, FloorLightsWhatIsAboveIt) {
  for (const float height : {0.3f, 0.05f}) {
    const PunctualLight spot = spotAt(Vec3(-0.2f, 0.5f, 0), Vec3(0, -1, 0));
    const Vec3 x(0.1f, height, 0.05f);
    const Scene scene = plateOverFloor(x, spot).build();
    const double expected = kAlbedo / kPi * irradianceFromFloor(spot, x);
    testing::expectRadiance(scene, testing::unbiased(testing::estimators(8, 1)), expected,
                            kTolerance, "height " + testing::number(height));
  }
}

// By way of a smooth mirror first, as if from the light's image behind it: no eye path finds that,
// so the VPLs must carry all of it, however near.
TEST(Glossy, MirroredLightIsWholeNearTheFloor) {
  const PunctualLight spot = spotAt(Vec3(-0.2f, 0.7f, 0), Vec3(0, 1, 0));
  const PunctualLight image = spotAt(Vec3(-0.2f, 1.3f, 0), Vec3(0, -1, 0));
  for (const float height : {0.3f, 0.15f}) {
    const Vec3 x(0.1f, height, 0.05f);
    SceneBuilder b = plateOverFloor(x, spot);
    b.quad(b.material(testing::mirror()), Vec3(-1, 1, -1), Vec3(2, 0, 0), Vec3(0, 0, 2));
    const double expected = kAlbedo / kPi * irradianceFromFloor(image, x);
    auto all = testing::unbiased(testing::estimators(8, 1));
    std::erase_if(all, [](const auto& e) { return e.facts().missesPunctualCaustics; });
    // The mirror and the floor, once each.
    for (auto& e : all) e.settings.specularDepth = 2, e.settings.indirectVpls = 1024;
    testing::expectRadiance(b.build(), all, expected, {.frames = 32, .bias = 5e-3, .error = 0.03},
                            "height " + testing::number(height));
  }
}

// The wall of a step that stands on glossy metal, just above the floor, as the path tracer sees it:
// photons of the default radius spill over the edge. Biased methods blur the wall's light over all
// of the step, 7 % at most.
TEST(Glossy, StepsOnMetalAgreeWithThePathTracer) {
  SceneBuilder b;
  b.box(b.material(testing::matte(Vec3(0.6f))), Vec3(-1), Vec3(1), true);
  b.quad(b.material(testing::matte(Vec3(0), Vec3(10))), Vec3(-0.3f, 0.99f, -0.3f), Vec3(0.6f, 0, 0),
         Vec3(0, 0, 0.6f));
  b.quad(b.material(glossyMetal(0.75f)), Vec3(-0.99f, -0.99f, 0.99f), Vec3(1.98f, 0, 0),
         Vec3(0, 0, -1.98f));
  b.box(b.material(testing::matte(Vec3(0.6f))), Vec3(-0.5f, -0.99f, -0.6f),
        Vec3(0.5f, -0.7f, -0.2f), false);
  b.camera(Vec3(0, -0.9f, 0), Vec3(0, -0.98f, -0.2f), 0.1f);
  const Scene scene = b.build();
  const Tracer tracer(scene, Isa::automatic);
  const auto reference = testing::render(tracer, testing::reference().settings, 256);
  for (testing::Estimator& e : testing::othersThanReference()) {
    e.settings.photonRadius = Settings{}.photonRadius;
    const auto image = testing::render(tracer, e.settings, 512);
    const double bias = e.facts().bias != nullptr ? 0.07 : 2e-3;
    EXPECT_NEAR(image.grey(), reference.grey(),
                4 * std::hypot(image.error(), reference.error()) + bias * reference.grey())
        << e.name;
    EXPECT_LT(std::hypot(image.error(), reference.error()), 0.015 * reference.grey()) << e.name;
  }
}

// Where all S lobes are glossy no photon is sent out, and a lobe less rough is theirs.
TEST(Glossy, PhotonsAreForWhatIsLessRough) {
  SceneBuilder b;
  Material metal = glossyMetal();
  b.quad(b.material(metal), Vec3(-1, 0, 1), Vec3(2, 0, 0), Vec3(0, 0, -2));
  EXPECT_FALSE(needsOf(b.build(), Radiance(0)).caustics);
  EXPECT_TRUE(needsOf(b.build(), Radiance(0)).glossy);
  metal.roughness = 0.9f * kGlossyRoughness;
  b.quad(b.material(metal), Vec3(-1, 1, 1), Vec3(2, 0, 0), Vec3(0, 0, -2));
  EXPECT_TRUE(needsOf(b.build(), Radiance(0)).caustics);
}

}  // namespace
}  // namespace ninefold
