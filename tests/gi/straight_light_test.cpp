// Light that passes straight through panes and blended surfaces, without any photon.
//
// A floor of albedo a under a point light of intensity I at height h, seen where the light is at
// the angle t from the vertical:
//
//   L = a/pi I cos^3(t)/h^2 T          T: product of what the surfaces between let pass
//
//   pane of index n    1 - 2F/(1+F) by Fresnel's F(t), its two faces and all bounces between them
//   blended            1 - opacity
#include "common/bsdf/bsdf.h"
#include "tests/gi/expect.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

constexpr float kAlbedo = 0.5f, kHeight = 0.8f;

Material pane(float index = 1.5f) {
  Material m = testing::glass(index);
  m.solid = false;
  return m;
}

Material blended(float opacity) {
  Material m = testing::matte(Vec3(0.3f));
  m.alphaMode = AlphaMode::blend, m.opacity = opacity;
  return m;
}

double passedByPane(double index, double t) {
  const double f = fresnelDielectric(static_cast<float>(std::cos(t)), static_cast<float>(index));
  return 1 - 2 * f / (1 + f);
}

// The floor at the angle t, one vertex, by instant radiosity without photons.
void expectPassed(const std::vector<Material>& between, double t, double passed) {
  SceneBuilder b;
  b.quad(b.material(testing::matte(Vec3(kAlbedo))), Vec3(-3, 0, 3), Vec3(6, 0, 0), Vec3(0, 0, -6));
  float y = 0.5f;
  for (const Material& m : between)
    b.quad(b.material(m), Vec3(-3, y += 0.05f, 3), Vec3(6, 0, 0), Vec3(0, 0, -6));
  PunctualLight point;
  point.position = Vec3(0, kHeight, 0);
  b.light(point);
  const Vec3 x(static_cast<float>(kHeight * std::tan(t)), 0, 0);
  b.camera(x + Vec3(0, 0.4f, 0), x, 1e-3f, Vec3(0, 0, 1));
  const Scene scene = b.build();
  const Tracer tracer(scene, Isa::automatic);
  Settings s = testing::radiosity(4, 1).settings;
  s.photons = 0;
  const double L = kAlbedo / double(kPi) * std::pow(std::cos(t), 3) / double(kHeight * kHeight);
  EXPECT_NEAR(testing::render(tracer, s, 1).grey(), L * passed, 1e-3 * L)
      << between.size() << " surfaces, angle " << t;
}

TEST(StraightLight, IsDimmedByWhatItPasses) {
  for (const double t : {0.0, 0.6, 1.1}) {
    expectPassed({pane()}, t, passedByPane(1.5, t));
    expectPassed({pane(1.2f), pane(1.8f)}, t, passedByPane(1.2, t) * passedByPane(1.8, t));
    expectPassed({blended(0.3f)}, t, 0.7);
    expectPassed({blended(0.3f), pane(), blended(0.6f)}, t, 0.7 * 0.4 * passedByPane(1.5, t));
    expectPassed({blended(0.3f), testing::matte(Vec3(1))}, t, 0);
  }
}

// What scatters is no straight pass: rough panes and solids keep their photons, and none are here.
TEST(StraightLight, DoesNotPassWhereItIsBent) {
  Material frosted = pane();
  frosted.roughness = 0.5f;
  expectPassed({frosted}, 0.6, 0);
  expectPassed({testing::glass(1.5f)}, 0.6, 0);
}

// Furnace: walls of albedo a that emit 1 show 1/(1-a), and clear panes change nothing: close before
// a wall, where the geometry term is bounded and comes back by rays through the pane, and one
// behind the other. No light is counted twice: photons still bring what the panes reflect.
// What the pane reflects comes by photons. Their radius blurs it where veil and pane stand close before
// the wall: with 2,000 photons a set 1.970 +- 0.004 are left of 2, with 20,000 1.992 +- 0.004.
TEST(StraightLight, PanesBeforeAWallAreInvisibleInAFurnace) {
  SceneBuilder b;
  b.box(b.material(testing::matte(Vec3(kAlbedo), Vec3(1))), Vec3(-1), Vec3(1), true);
  const int clear = b.material(pane()), veil = b.material(blended(0));
  b.quad(clear, Vec3(-0.9f, -0.9f, -0.97f), Vec3(1.8f, 0, 0), Vec3(0, 1.8f, 0));
  b.quad(clear, Vec3(-0.9f, -0.95f, 0.5f), Vec3(1.8f, 0, 0), Vec3(0, 0, -1.4f));
  b.quad(veil, Vec3(-0.9f, -0.9f, -0.9f), Vec3(1.8f, 0, 0), Vec3(0, 1.8f, 0));
  b.camera(Vec3(0, 0.1f, 0.95f), Vec3(0.05f, -0.6f, -0.9f), 1.0f);
  const Scene scene = b.build();
  for (const int n : {1, 0}) {
    std::vector<testing::Estimator> all = testing::estimators(8, n);
    for (testing::Estimator& e : all) e.settings.photons = 20000;
    testing::expectRadiance(scene, all, testing::furnaceRadiance(kAlbedo, n),
                            {.frames = 64, .bias = 2e-3, .error = 0.02},
                            "path length " + testing::number(n));
  }
}

}  // namespace
}  // namespace ninefold
