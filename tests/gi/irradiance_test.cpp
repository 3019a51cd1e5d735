// Irradiance against closed forms, gathered by the product's own code: emitters become VPLs of many
// sets, a single receiver gathers them.
#include <gtest/gtest.h>

#include "common/gi/radiosity/radiosity.h"
#include "common/gi/vpl/vpl_gather.h"
#include "tests/gi/closed_form.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::lambert;
using testing::SceneBuilder;

struct Measured {
  double mean = 0, error = 0;
};

// Mean red irradiance at x with normal n over `sets` frames.
Measured irradianceAt(const Scene& scene, Vec3 x, Vec3 n, int directVpls = 16, int sets = 64) {
  const Tracer tracer(scene, Isa::automatic);
  Settings settings;
  settings.directVpls = directVpls, settings.indirectVpls = 0, settings.bound = 1e6f;
  settings.environment = scene.environment;
  const Transport transport(tracer, settings);
  double sum = 0, squares = 0;
  for (int i = 0; i < sets; ++i) {
    const LightSet lights =
        makeLightSet(transport, FrameKey{0, static_cast<uint32_t>(i), 0, 0.1f}, i % 9, -1);
    Receivers receivers;
    receivers.add(Receiver{x, n, n, x + 1e-5f * n, 0, 1});
    receivers.pad();
    uint64_t rays = 0;
    VplGatherScratch scratch;
    gatherVpls(transport, lights, ReceiverSamples(0, static_cast<uint32_t>(i), 0), 1,
               settings.vplRoulette, scratch, receivers, rays);
    const double e = receivers.er[0];
    sum += e, squares += e * e;
  }
  const double mean = sum / sets;
  return {mean, std::sqrt(std::max(squares / sets - mean * mean, 0.0) / (sets - 1))};
}

// A far, tiny triangle gives the scene geometry and the bounds some size without blocking anything.
void addSpeck(SceneBuilder& b) {
  b.quad(b.material(testing::matte(Vec3(0.5f))), Vec3(-5, -5, -5), Vec3(0.01f, 0, 0),
         Vec3(0, 0, 0.01f));
}

TEST(Irradiance, PolygonLightMeetsLambertsFormula) {
  SceneBuilder b;
  const int lamp = b.material(testing::matte(Vec3(0), Vec3(3)));
  // Looks down: cross(u, v) = -y.
  b.quad(lamp, Vec3(-0.5f, 1, -0.5f), Vec3(1, 0, 0), Vec3(0, 0, 1.5f));
  addSpeck(b);
  const Scene scene = b.build();
  const std::vector<glm::dvec3> corners = {
      {-0.5, 1, -0.5}, {0.5, 1, -0.5}, {0.5, 1, 1.0}, {-0.5, 1, 1.0}};
  for (const Vec3 x : {Vec3(0, 0, 0), Vec3(0.7f, 0.2f, -0.4f), Vec3(-2, 0.5f, 1)}) {
    const Measured e = irradianceAt(scene, x, Vec3(0, 1, 0));
    const double expected = 3 * lambert(corners, glm::dvec3(x), {0, 1, 0});
    EXPECT_NEAR(e.mean, expected, 4 * e.error + 1e-5) << "at " << x.x << "," << x.y << "," << x.z;
    EXPECT_LT(e.error, 0.02 * expected);
  }
}

TEST(Irradiance, FrontOnlyUnlessDoubleSided) {
  for (const bool both : {false, true}) {
    SceneBuilder b;
    Material lamp = testing::matte(Vec3(0), Vec3(2));
    lamp.doubleSided = both;
    b.quad(b.material(lamp), Vec3(-1, 0, -1), Vec3(2, 0, 0), Vec3(0, 0, 2));  // front looks down
    addSpeck(b);
    const Scene scene = b.build();
    const double full =
        2 * lambert({{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}}, {0, 1, 0}, {0, 1, 0});
    const Measured below = irradianceAt(scene, Vec3(0, -1, 0), Vec3(0, 1, 0));
    const Measured above = irradianceAt(scene, Vec3(0, 1, 0), Vec3(0, -1, 0));
    EXPECT_NEAR(below.mean, full, 4 * below.error + 1e-5);
    EXPECT_NEAR(above.mean, both ? full : 0.0, 4 * above.error + 1e-5);
  }
}

TEST(Irradiance, PunctualLightsAreExact) {
  PunctualLight lamp;
  lamp.position = Vec3(0, 2, 0), lamp.intensity = Vec3(5), lamp.direction = Vec3(0, -1, 0);
  const Vec3 x(1, 0, 0);
  const double d2 = 5, cosine = 2 / std::sqrt(5.0);
  const auto withLight = [&] {
    SceneBuilder b;
    addSpeck(b);
    return b.light(lamp).build();
  };
  lamp.kind = LightKind::point;
  EXPECT_NEAR(irradianceAt(withLight(), x, Vec3(0, 1, 0)).mean, 5 * cosine / d2, 1e-5);

  // glTF's spot: falloff ((cos - cos outer) / (cos inner - cos outer))^2.
  lamp.kind = LightKind::spot, lamp.innerCone = 0.2f, lamp.outerCone = 0.7f;
  const double ramp = (cosine - std::cos(0.7)) / (std::cos(0.2) - std::cos(0.7));
  EXPECT_NEAR(irradianceAt(withLight(), x, Vec3(0, 1, 0)).mean, 5 * cosine / d2 * ramp * ramp,
              1e-5);
  EXPECT_EQ(irradianceAt(withLight(), Vec3(3, 0, 0), Vec3(0, 1, 0)).mean, 0);

  // A goniometric light: f = theta/180 towards +x, half of that towards -x.
  SceneBuilder b;
  addSpeck(b);
  lamp.across = Vec3(1, 0, 0);
  b.goniometric(lamp, {0, 180}, {0, 180, 360},
                [](float theta, float phi) { return theta / (phi == 180 ? 360 : 180); });
  const Scene scene = b.build();
  const double theta = std::acos(cosine) / std::acos(-1.0);
  EXPECT_NEAR(irradianceAt(scene, x, Vec3(0, 1, 0)).mean, 5 * cosine / d2 * theta, 1e-5);
  EXPECT_NEAR(irradianceAt(scene, -x, Vec3(0, 1, 0)).mean, 5 * cosine / d2 * theta / 2, 1e-5);

  lamp.kind = LightKind::directional, lamp.direction = glm::normalize(Vec3(1, -1, 0));
  EXPECT_NEAR(irradianceAt(withLight(), x, Vec3(0, 1, 0)).mean, 5 * std::sqrt(0.5), 1e-5);
}

TEST(Irradiance, ConstantEnvironmentGivesPi) {
  SceneBuilder b;
  addSpeck(b);
  const Scene scene = b.environment(Radiance(1)).build();
  const Measured e = irradianceAt(scene, Vec3(0, 0, 0), Vec3(0, 1, 0), 64, 64);
  EXPECT_NEAR(e.mean, static_cast<double>(kPi), 4 * e.error + 1e-3);
}

TEST(Irradiance, MirroredInstanceEmitsFromItsTrueFront) {
  // A lamp that looks down, mirrored at y = 0, must look up.
  SceneBuilder b;
  const int lamp = b.material(testing::matte(Vec3(0), Vec3(2)));
  b.quad(lamp, Vec3(-1, 1, -1), Vec3(2, 0, 0), Vec3(0, 0, 2));
  addSpeck(b);
  Scene scene = b.build();
  scene.instances[0].toWorld[1][1] = -1;
  const Measured above = irradianceAt(scene, Vec3(0, 0, 0), Vec3(0, -1, 0));
  EXPECT_GT(above.mean, 1.0);
  const Measured below = irradianceAt(scene, Vec3(0, -2, 0), Vec3(0, 1, 0));
  EXPECT_EQ(below.mean, 0.0);
}

}  // namespace
}  // namespace ninefold
