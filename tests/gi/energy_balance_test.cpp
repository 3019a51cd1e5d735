// Energy balance: what flows into a closed box is absorbed by its walls, glass or mirrors in it or
// not. Lossless objects hand on what they get, so that with walls of one albedo a, and flux Phi
// from the lights, after n diffuse vertices
//
//   integral of E over the walls = Phi (1 + a + ... + a^(n-1))          [W]
//
// and what is absorbed is (1 - a) times that: all of Phi for n without limit. Six pictures measure
// it: the eye stands between the object and a wall and sees all of that wall, as a plane across the
// view, so that equal pixels are equal areas:  integral of E = area * mean(L - L_e) pi / a.
#include <functional>

#include "tests/gi/expect.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

constexpr double kAlbedo = 0.5;
constexpr float kEye = 0.6f;  // distance of the eye from the middle: objects stay within it

struct Box {
  SceneBuilder b;
  double flux = 0;      // from the lights [W]
  double emission = 0;  // L_e of the ceiling
};

// A room [-1, 1]^3 whose ceiling emits radiance 1: Phi = pi 4.
Box litByCeiling() {
  Box box;
  const int wall = box.b.material(testing::matte(Vec3(float(kAlbedo))));
  const int lamp = box.b.material(testing::matte(Vec3(float(kAlbedo)), Vec3(1)));
  box.b.box(wall, Vec3(-1), Vec3(1), true);
  box.b.quad(lamp, Vec3(-1, 0.9999f, -1), Vec3(2, 0, 0), Vec3(0, 0, 2));
  box.flux = 4 * static_cast<double>(kPi), box.emission = 1;
  return box;
}

// The same lit by a point light of 1 W/sr in a corner: Phi = 4 pi.
Box litByPoint() {
  Box box;
  box.b.box(box.b.material(testing::matte(Vec3(float(kAlbedo)))), Vec3(-1), Vec3(1), true);
  PunctualLight point;
  point.position = Vec3(0.7f, 0.8f, 0.6f), point.intensity = Vec3(1);
  box.b.light(point);
  box.flux = 4 * static_cast<double>(kPi);
  return box;
}

struct Received {
  double flux = 0, error = 0;  // [W]
};

// Integral of E over all walls.
Received receivedFlux(const Box& box, Settings settings, int frames) {
  Received sum;
  double variance = 0;
  for (int side = 0; side < 6; ++side) {
    Vec3 axis(0), up(0);
    axis[side / 2] = side % 2 == 0 ? 1.0f : -1.0f, up[(side / 2 + 1) % 3] = 1;
    SceneBuilder b = box.b;
    b.camera(kEye * axis, axis, 2 * std::atan(1 / (1 - kEye)), up);
    const Scene scene = b.build();
    const Tracer tracer(scene, Isa::automatic);
    ++settings.seed;  // the six pictures' errors are independent
    const auto image = testing::render(tracer, settings, frames);
    const double scale = 4 * static_cast<double>(kPi) / kAlbedo;
    sum.flux += scale * (image.grey() - (axis.y > 0 ? box.emission : 0));
    variance += scale * scale * image.error() * image.error();
  }
  sum.error = std::sqrt(variance);
  return sum;
}

void expectBalance(const Box& box, const Settings& settings, double share,
                   const testing::Tolerance& t, const std::string& what) {
  const int n = settings.pathLength;
  const double vertices = n == 0 ? 1 / (1 - kAlbedo) : (1 - std::pow(kAlbedo, n)) / (1 - kAlbedo);
  const double expected = share * box.flux * vertices;
  const Received got = receivedFlux(box, settings, t.frames);
  EXPECT_NEAR(got.flux, expected, 5 * got.error + t.bias * expected)
      << what << ": " << got.flux / expected << " +- " << got.error / expected;
  EXPECT_LT(got.error, t.error * expected) << what;
}

// Wide disks for few photons. Bias: what disks cover at the walls' edges is known roughly.
void widen(Settings& s) { s.photons = 500, s.photonRadius = 0.03f; }
std::vector<testing::Estimator> estimators(int pathLength) {
  auto all = testing::estimators(8, pathLength);
  all.push_back(testing::mapAtVertices(8, pathLength));
  for (auto& e : all) widen(e.settings);
  return all;
}
constexpr testing::Tolerance kTolerance{.frames = 40, .bias = 5e-3};

// An area light: every method finds every path.
void expectAllIsAbsorbed(const std::function<void(SceneBuilder&)>& add,
                         std::initializer_list<int> pathLengths = {1, 0}) {
  for (const int pathLength : pathLengths)
    for (auto& e : estimators(pathLength)) {
      Box box = litByCeiling();
      add(box.b);
      expectBalance(box, e.settings, 1, kTolerance, e.name);
    }
}

TEST(EnergyBalance, EmptyBox) {
  expectAllIsAbsorbed([](SceneBuilder&) {});
}

TEST(EnergyBalance, GlassBall) {
  expectAllIsAbsorbed(
      [](SceneBuilder& b) { b.sphere(b.material(testing::glass(1.5f)), Vec3(0), 0.5f, 32); });
}

TEST(EnergyBalance, GlassCube) {
  expectAllIsAbsorbed([](SceneBuilder& b) {
    b.box(b.material(testing::glass(1.5f)), Vec3(-0.4f), Vec3(0.4f), false);
  });
}

void addMirrorBall(SceneBuilder& b) { b.sphere(b.material(testing::mirror()), Vec3(0), 0.5f, 32); }
TEST(EnergyBalance, MirrorBallAndOneVertex) { expectAllIsAbsorbed(addMirrorBall, {1}); }
TEST(EnergyBalance, MirrorBall) { expectAllIsAbsorbed(addMirrorBall, {0}); }

// A point light: caustics are the photons' alone. Some methods cannot find them, as they say: on
// walls that bounce nothing on (one vertex) they lack exactly what meets the ball, the share of the
// sphere of directions in the cone sin t = r/d:  (1 - cos t)/2.
TEST(EnergyBalance, PointLightBesideAGlassBall) {
  Box box = litByPoint();
  box.b.sphere(box.b.material(testing::glass(1.5f)), Vec3(0), 0.5f, 32);
  const double sine = 0.5 / std::sqrt(0.7 * 0.7 + 0.8 * 0.8 + 0.6 * 0.6);
  const double missed = (1 - std::sqrt(1 - sine * sine)) / 2;
  for (auto& e : estimators(1)) {
    const double found = e.facts().missesPunctualCaustics ? 1 - missed : 1;
    expectBalance(box, e.settings, found, {.frames = 96, .bias = 5e-3}, e.name);
  }
}

// Disks half as wide as a wall, one in two partly outside it: what they cover outside must not be
// lost. Plain density estimation would lose 20 %.
TEST(EnergyBalance, WideDisksLoseNothingAtTheEdges) {
  Box box = litByPoint();
  box.b.sphere(box.b.material(testing::glass(1.5f)), Vec3(0), 0.3f, 32);
  Settings s = testing::radiosity(8, 1).settings;
  s.photons = 2000, s.photonRadius = 0.3f;
  expectBalance(box, s, 1, {.frames = 40, .bias = 0.01}, "radius 0.3");
}

// One photon a set, or two, estimate the same mean as many: what is emitted counts, not what lands.
TEST(EnergyBalance, OnePhotonIsEnoughForTheMean) {
  Box box = litByPoint();
  box.b.sphere(box.b.material(testing::glass(1.5f)), Vec3(0), 0.5f, 32);
  Settings s = testing::radiosity(8, 2).settings;
  widen(s), s.indirectVpls = 16;
  for (const int photons : {1, 2}) {
    s.photons = photons;
    expectBalance(box, s, 1, {.frames = 200, .bias = 5e-3, .error = 0.03},
                  "photons: " + testing::number(photons));
  }
}

}  // namespace
}  // namespace ninefold
