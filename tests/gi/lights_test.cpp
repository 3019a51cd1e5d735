// Lights of every size and strength, seen and unseen, and none at all. Receivers of albedo a show
// L = a E/pi after one diffuse vertex, and E has a formula.
#include "tests/gi/closed_form.h"
#include "tests/gi/expect.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::kExactPi;
using testing::number;
using testing::SceneBuilder;

constexpr double kAlbedo = 0.5;

// A floor in y = 0, and an eye that looks at one point of it, from the side.
SceneBuilder floorSeenAt(Vec3 point) {
  SceneBuilder b;
  b.quad(b.material(testing::matte(Vec3(0.5f))), Vec3(-3, 0, 3), Vec3(6, 0, 0), Vec3(0, 0, -6));
  b.camera(point + Vec3(0.1f, 0.2f, 0.3f), point, 1e-3f);
  return b;
}

// A square lamp that looks down, of side `side` around `middle`.
void addLamp(SceneBuilder& b, float radiance, Vec3 middle, float side) {
  const Vec3 half(0.5f * side, 0, 0.5f * side);
  b.quad(b.material(testing::matte(Vec3(0), Vec3(radiance))), middle - half, Vec3(side, 0, 0),
         Vec3(0, 0, side));
}

double irradianceUnder(Vec3 middle, float side, Vec3 x) {
  const DVec3 m(middle), u(0.5 * double(side), 0, 0), v(0, 0, 0.5 * double(side));
  return testing::lambert({m - u - v, m + u - v, m + u + v, m - u + v}, DVec3(x), DVec3(0, 1, 0));
}

// Area 1e-10 m^2, 1 m away: a point for all that matters, E = L A cos_x cos_y/d^2.
TEST(Lights, AreaOfATenthOfABillionthOfASquareMetre) {
  const Vec3 x(0.5f, 0, 0);
  SceneBuilder b = floorSeenAt(x);
  addLamp(b, 1e10f, Vec3(0, 1, 0), 1e-5f);
  const double d2 = 1.25, cosine = 1 / std::sqrt(d2);
  const double expected = kAlbedo / kExactPi * cosine * cosine / d2;
  testing::expectRadiance(b.build(), testing::estimators(8, 1), expected, {.bias = 1e-3});
}

// ... near by too, a hundred times within the bound of the geometry term: nothing would meet it by
// chance, and if something did, it would be a firefly of 1e10.
TEST(Lights, SmallOnesLightWhatIsNearThem) {
  const Vec3 x(0.05f, 0, 0);
  const float h = 0.1f;
  SceneBuilder b = floorSeenAt(x);
  addLamp(b, 1e10f, Vec3(0, h, 0), 1e-5f);
  const double d2 = h * h + x.x * x.x;
  const double expected = kAlbedo / kExactPi * h * h / (d2 * d2);
  testing::expectRadiance(b.build(), testing::estimators(8, 1), expected, {.bias = 1e-3});
}

// Radiance 1e-6 beside 1e6, both in view of the floor: the sum, which is the strong one's.
TEST(Lights, AFaintOneBesideAStrongOne) {
  const Vec3 x(0), strong(-0.5f, 1, 0), faint(0.5f, 1, 0);
  SceneBuilder b = floorSeenAt(x);
  addLamp(b, 1e6f, strong, 0.5f), addLamp(b, 1e-6f, faint, 0.5f);
  const double expected = kAlbedo / kExactPi * 1e6 * irradianceUnder(strong, 0.5f, x);
  testing::expectRadiance(b.build(), testing::estimators(8, 1), expected, {.bias = 1e-5});
}

// ... and where the strong one is hidden behind a wall, the faint one alone: it must not drown for
// being one part in 10^12 of all the power.
TEST(Lights, AFaintOneWhereTheStrongOneIsHidden) {
  const Vec3 x(0), strong(-1.5f, 1, 0), faint(0.5f, 1, 0);
  SceneBuilder b = floorSeenAt(x);
  addLamp(b, 1e6f, strong, 0.5f), addLamp(b, 1e-6f, faint, 0.5f);
  b.quad(b.material(testing::matte(Vec3(0))), Vec3(-0.5f, 0, -3), Vec3(0, 0, 6), Vec3(0, 3, 0));
  const double expected = kAlbedo / kExactPi * 1e-6 * irradianceUnder(faint, 0.5f, x);
  auto all = testing::estimators(8, 1);
  for (auto& e : all) e.settings.vplRoulette = 0;
  testing::expectRadiance(b.build(), all, expected, {.frames = 300, .error = 0.02});
}

// Most virtual lights are the strong lamp's, and roulette leaves out what adds next to nothing if
// nothing were between: it must leave some chance to what is not hidden.
TEST(Lights, AFaintOneWhereTheStrongOneIsHiddenAlsoWithRoulette) {
  const Vec3 x(0), strong(-1.5f, 1, 0), faint(0.5f, 1, 0);
  SceneBuilder b = floorSeenAt(x);
  addLamp(b, 1e6f, strong, 0.5f), addLamp(b, 1e-6f, faint, 0.5f);
  b.quad(b.material(testing::matte(Vec3(0))), Vec3(-0.5f, 0, -3), Vec3(0, 0, 6), Vec3(0, 0.9f, 0));
  const double expected = kAlbedo / kExactPi * 1e-6 * irradianceUnder(faint, 0.5f, x);
  auto e = testing::radiosity(8, 1);
  e.settings.vplRoulette = 3;
  testing::expectRadiance(b.build(), {e}, expected, {.frames = 1200, .error = 0.1});
}

// Ten thousand lamps of a millimetre: E is the sum of L A cos cos/d^2.
TEST(Lights, TenThousandOfThem) {
  const Vec3 x(0.3f, 0, 0.2f);
  SceneBuilder b = floorSeenAt(x);
  double sum = 0;
  for (int i = 0; i < 100; ++i)
    for (int j = 0; j < 100; ++j) {
      const Vec3 at(0.04f * static_cast<float>(i - 50), 1, 0.04f * static_cast<float>(j - 50));
      addLamp(b, 100, at, 1e-3f);
      const DVec3 off = DVec3(at) - DVec3(x);
      sum += 100 * 1e-6 / std::pow(glm::dot(off, off), 2);
    }
  auto all = testing::estimators(8, 1);
  for (auto& e : all) e.settings.directVpls = 64;
  testing::expectRadiance(b.build(), all, kAlbedo / kExactPi * sum, {.bias = 1e-3});
}

void expectBlack(const Scene& scene) {
  const Tracer tracer(scene, Isa::automatic);
  for (auto& e : testing::estimators()) {
    e.settings.mapDistance = 0.1f;  // a pool's light leaks to what lies D/8 below a lit floor
    for (const Vec3& p : testing::render(tracer, e.settings, 8).pixels)
      EXPECT_EQ(p, Vec3(0)) << e.name;
  }
}

// Within a closed opaque box a lamp lights nothing outside; not through edges and corners either.
TEST(Lights, HiddenInABoxNothingGetsOut) {
  SceneBuilder b = floorSeenAt(Vec3(0.5f, 0, 0));
  b.box(b.material(testing::matte(Vec3(0.9f))), Vec3(-0.2f, 0.1f, -0.2f), Vec3(0.2f, 0.5f, 0.2f),
        false);
  addLamp(b, 100, Vec3(0, 0.49f, 0), 0.3f);
  b.sphere(b.material(testing::glass(1.5f)), Vec3(0.7f, 0.3f, 0), 0.2f, 16);
  expectBlack(b.build());
}

TEST(Lights, NoneOrNoneWithPower) {
  SceneBuilder none = floorSeenAt(Vec3(0));
  none.sphere(none.material(testing::glass(1.5f)), Vec3(0.7f, 0.3f, 0), 0.2f, 16);
  SceneBuilder dark = none;
  expectBlack(none.build());
  addLamp(dark, 0, Vec3(0, 1, 0), 1);
  PunctualLight light;
  light.intensity = Vec3(0), light.position = Vec3(0, 1, 0), light.direction = Vec3(0, -1, 0);
  for (const LightKind kind : {LightKind::point, LightKind::spot, LightKind::directional}) {
    light.kind = kind;
    dark.light(light);
  }
  expectBlack(dark.build());
}

// A lamp whose texture is black on one half: E is that of the other half.
TEST(Lights, TexturedOnesShineWhereTheirTextureDoes) {
  const Vec3 x(0.2f, 0, 0);
  SceneBuilder b = floorSeenAt(x);
  addLamp(b, 3, Vec3(0, 1, 0), 1);
  Scene scene = b.build();
  // 2 x 1 texels without interpolation; u runs along +x: white where x > 0.
  scene.images.push_back({"halves", 2, 1, 1, false, {0, 255}});
  TextureUse use;
  use.image = 0, use.nearest = true, use.wrapS = Wrap::clamp;
  scene.materials[1].emissionMap = use;
  scene.meshes[1].uv0 = {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
  const double half = testing::lambert({{0, 1, -0.5}, {0.5, 1, -0.5}, {0.5, 1, 0.5}, {0, 1, 0.5}},
                                       DVec3(x), DVec3(0, 1, 0));
  testing::expectRadiance(scene, testing::estimators(8, 1), kAlbedo / kExactPi * 3 * half);
}

// A lamp that only a mirror sees: it looks along +x into a perfect mirror in x = 1/2, and the floor
// behind it gets what the lamp's image in x = 1 sends back.
TEST(Lights, SeenOnlyInAMirror) {
  const Vec3 x(-0.5f, 0, 0);
  SceneBuilder b = floorSeenAt(x);
  b.quad(b.material(testing::mirror()), Vec3(0.5f, 0.01f, -1), Vec3(0, 0, 2), Vec3(0, 1, 0));
  b.quad(b.material(testing::matte(Vec3(0), Vec3(1))), Vec3(0, 0.5f, -0.5f), Vec3(0, 0.4f, 0),
         Vec3(0, 0, 1));
  const double expected =
      kAlbedo / kExactPi *
      testing::lambert({{1, 0.5, -0.5}, {1, 0.9, -0.5}, {1, 0.9, 0.5}, {1, 0.5, 0.5}}, DVec3(x),
                       DVec3(0, 1, 0));
  auto all = testing::estimators(8, 1);
  for (auto& e : all) e.settings.photonRadius = 0.03f;
  testing::expectRadiance(b.build(), all, expected, {.frames = 400, .bias = 5e-3, .error = 0.03});
}

// Point: I cos/d^2. Spot: that times glTF's falloff ((cos - cos outer)/(cos inner - cos outer))^2.
// Directional: E0 cos.
TEST(Lights, PunctualOnesOfEachKind) {
  const Vec3 x(0.5f, 0, 0);
  PunctualLight light;
  light.position = Vec3(0, 1, 0), light.intensity = Vec3(2);
  light.innerCone = 0.2f, light.outerCone = 0.7f;
  const double cosine = 1 / std::sqrt(1.25);
  const double ramp = (cosine - std::cos(0.7)) / (std::cos(0.2) - std::cos(0.7));
  struct Case {
    LightKind kind;
    Vec3 direction;
    double irradiance;
  };
  for (const Case& c :
       {Case{LightKind::point, Vec3(0, -1, 0), 2 * cosine / 1.25},
        Case{LightKind::spot, Vec3(0, -1, 0), 2 * cosine / 1.25 * ramp * ramp},
        Case{LightKind::directional, glm::normalize(Vec3(1, -1, 0)), 2 * std::sqrt(0.5)}}) {
    SceneBuilder b = floorSeenAt(x);
    light.kind = c.kind, light.direction = c.direction;
    b.light(light);
    testing::expectRadiance(b.build(), testing::estimators(8, 1), kAlbedo / kExactPi * c.irradiance,
                            {.frames = 4, .bias = 2e-3},
                            "kind " + number(static_cast<int>(c.kind)));
  }
}

// Punctual lights in the plane of a ceiling light what is below.
TEST(Lights, PunctualOnesInTheCeiling) {
  const Vec3 x(0.5f, 0, 0);
  SceneBuilder b = floorSeenAt(x);
  b.quad(b.material(testing::matte(Vec3(0))), Vec3(-2, 1, -2), Vec3(4, 0, 0), Vec3(0, 0, 4));
  PunctualLight light;
  light.position = Vec3(0, 1, 0), light.intensity = Vec3(1);
  b.light(light);
  const double expected = kAlbedo / kExactPi / std::pow(1.25, 1.5);
  testing::expectRadiance(b.build(), testing::estimators(8, 1), expected, {.frames = 4});
}

}  // namespace
}  // namespace ninefold
