// Light inside an absorbing solid. Two wide plates at distance h, each emitting radiance 1 with
// albedo a, in a medium of index 1 that absorbs sigma per metre, tau = sigma h. From one plate the
// other fills the sky, at distance h/cos:
//
//   E = B integral of cos exp(-tau/cos) dw = B 2 pi E3(tau)        E3: exponential integral
//   B = 1 + a/pi E = 1 + 2 a E3 B = 1/(1 - 2 a E3)     without limit; with n diffuse vertices
//                                                      the partial sum of (2 a E3)^i, i = 0..n
//
// An eye halfway between sees B exp(-tau/2) straight on. Plates 2 wide at h = 0.02: 1e-4 of E is
// missing at the sides.
#include "tests/gi/closed_form.h"
#include "tests/gi/expect.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

constexpr float kApart = 0.02f;
constexpr double kAlbedo = 0.8;

// A clear medium of index 1 that keeps exp(-tau) over `distance`.
Material absorbing(double tau, float distance) {
  Material m = testing::glass(1);
  m.attenuationColor = Vec3(static_cast<float>(std::exp(-tau)));
  m.attenuationDistance = distance;
  return m;
}

double thirdExponentialIntegral(double x) {
  const double e1 = -std::expint(-x), e2 = std::exp(-x) - x * e1;
  return (std::exp(-x) - x * e2) / 2;
}

Scene plates(double tau) {
  SceneBuilder b;
  const int plate = b.material(testing::matte(Vec3(float(kAlbedo)), Vec3(1)));
  b.box(b.material(absorbing(tau, kApart)), Vec3(-1.5f), Vec3(1.5f), false);
  b.quad(plate, Vec3(-1, 0, 1), Vec3(2, 0, 0), Vec3(0, 0, -2));
  b.quad(plate, Vec3(-1, kApart, -1), Vec3(2, 0, 0), Vec3(0, 0, 2));
  b.camera(Vec3(0.1f, 0.5f * kApart, 0.2f), Vec3(0.1f, 0, 0.2f), 0.02f, Vec3(0, 0, 1));
  return b.build();
}

// Near the plates the bound cuts nearly everything off: both halves, bounded and given back, count.
void expectThirdExponentialIntegral(double tau) {
  for (const int n : {1, 2, 0}) {
    const double kept = kAlbedo * 2 * thirdExponentialIntegral(tau);
    const double B = testing::furnaceRadiance(kept, n);
    auto all = testing::estimators(8, n);
    // Where few lines near the horizon pass, they pass few nodes, and light comes out too bright
    // by what is dimmed along them.
    for (testing::Estimator& e : all)
      e.settings.fieldDistances = 64, e.settings.fieldPhotons = 4096;
    for (testing::Estimator e : std::vector(all)) {
      if (!e.facts().has(kDirectVpls)) continue;
      e.name += " with a low bound", e.settings.bound = 0.01f;
      all.push_back(e);
    }
    testing::expectRadiance(plates(tau), all, B * std::exp(-tau / 2), {.bias = 1e-3, .error = 0.02},
                            "tau " + testing::number(tau) + ", n " + testing::number(n));
  }
}

TEST(Absorption, PlatesInAThinMediumMeetTheExponentialIntegral) {
  expectThirdExponentialIntegral(0.1);
}

TEST(Absorption, PlatesInADenseMediumMeetTheExponentialIntegral) {
  expectThirdExponentialIntegral(1);
}

// A lamp of 1 W/sr in the medium, small enough to be a point, lights a floor of albedo a from a
// height d: E = exp(-sigma d)/d^2, and an eye s away sees a E/pi exp(-sigma s). Point lights
// likewise. The floor is seen by way of a mirror too: the path there counts whole.
TEST(Absorption, LampsAndEyesInAMediumAreDimmedOnTheWholeWay) {
  const float sigma = 0.7f, d = 0.8f, s = 0.4f, side = 1e-3f;
  for (const bool point : {false, true})
    for (const bool byMirror : {false, true}) {
      SceneBuilder b;
      b.box(b.material(absorbing(static_cast<double>(sigma), 1)), Vec3(-3), Vec3(3), false);
      b.quad(b.material(testing::matte(Vec3(0.5f))), Vec3(-1, 0, 1), Vec3(2, 0, 0), Vec3(0, 0, -2));
      if (point) {
        PunctualLight light;
        light.position = Vec3(0, d, 0), light.intensity = Vec3(1);
        b.light(light);
      } else {
        const Vec3 half(side / 2, 0, side / 2);
        b.quad(b.material(testing::matte(Vec3(0), Vec3(1 / (side * side)))), Vec3(0, d, 0) - half,
               Vec3(side, 0, 0), Vec3(0, 0, side));
      }
      // The mirror, at 45 degrees above x = 0.1, turns a horizontal view down; s is the way's
      // length.
      const float x = 0.1f, up = 0.3f;
      if (byMirror) {
        b.quad(b.material(testing::mirror()), Vec3(x - 0.01f, up - 0.01f, -0.01f), Vec3(0, 0, 0.1f),
               Vec3(0.1f, 0.1f, 0));
        b.camera(Vec3(x + s - up, up, 0), Vec3(x, up, 0), 1e-3f);
      } else {
        b.camera(Vec3(x, s, 0), Vec3(x, 0, 0), 1e-3f, Vec3(0, 0, 1));
      }
      const double d2 = d * d + x * x, way = std::sqrt(d2) + s;
      const double expected = 0.5 / testing::kExactPi * std::exp(-sigma * way) * d / d2 *
                              (point ? 1 : d / std::sqrt(d2)) / std::sqrt(d2);
      testing::expectRadiance(b.build(), testing::estimators(8, 1), expected, {.bias = 2e-3},
                              std::string(point ? "point" : "area") + (byMirror ? ", mirror" : ""));
    }
}

}  // namespace
}  // namespace ninefold
