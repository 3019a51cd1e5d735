// Scale: radiance does not know how long a metre is. A room with shadows, a glass ball, a thin pane
// and rough metal, lit by a lamp, scaled by s: all lengths times s, radiance as it was; a point
// light's intensity times s^2 (E = I/d^2), attenuation distances times s.
//
// For s = 2^k every rounding is the same, so the picture must be the same bit for bit unless a
// length is hidden in the code; k = -13 and 20 make rooms of 0.1 mm and 1000 km. Other factors
// round otherwise and agree within the standard error.
#include "tests/gi/expect.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::number;
using testing::SceneBuilder;

Scene room(float s) {
  SceneBuilder b;
  const int wall = b.material(testing::matte(Vec3(0.6f, 0.5f, 0.4f)));
  const int lamp = b.material(testing::matte(Vec3(0), Vec3(8)));
  Material tinted = testing::glass(1.5f);
  tinted.attenuationColor = Vec3(0.3f, 0.8f, 0.5f), tinted.attenuationDistance = 0.5f * s;
  Material pane = testing::glass(1.5f);
  pane.solid = false;
  Material metal = testing::mirror(Vec3(0.9f, 0.7f, 0.4f));
  metal.roughness = 0.4f;
  b.box(wall, Vec3(-s), Vec3(s), true);
  b.quad(lamp, s * Vec3(-0.3f, 0.98f, -0.3f), s * Vec3(0.6f, 0, 0), s * Vec3(0, 0, 0.6f));
  b.sphere(b.material(tinted), s * Vec3(0.4f, -0.6f, -0.2f), s * 0.3f, 16);
  b.sphere(b.material(metal), s * Vec3(-0.4f, -0.6f, -0.3f), s * 0.3f, 16);
  b.quad(b.material(pane), s * Vec3(-0.8f, -0.9f, 0.2f), s * Vec3(0.5f, 0, 0),
         s * Vec3(0, 1.2f, 0));
  PunctualLight point;
  point.position = s * Vec3(0.5f, 0.5f, 0.7f), point.intensity = Vec3(0.5f * s * s);
  b.light(point).camera(s * Vec3(0, 0, 0.95f), s * Vec3(0, -0.25f, -1), 1.2f);
  return b.build();
}

testing::Rendered picture(float s, const testing::Estimator& e, int frames) {
  const Scene scene = room(s);
  const Tracer tracer(scene, Isa::automatic);
  return testing::render(tracer, e.settings, frames);
}

TEST(Scale, PowersOfTwoGiveTheSameBits) {
  for (const auto& e : testing::estimators(16)) {
    const auto expected = picture(1, e, 4);
    for (const float s : {0x1p-13f, 0x1p-3f, 0x1p20f})
      EXPECT_EQ(picture(s, e, 4).pixels, expected.pixels) << e.name << ", " << s << " m";
  }
}

TEST(Scale, FromATenthOfAMillimetreToAThousandKilometres) {
  for (const auto& e : testing::estimators(8)) {
    const auto expected = picture(1, e, 128);
    for (const float s : {1e-4f, 1e6f}) {
      const auto image = picture(s, e, 128);
      const double error = std::hypot(image.error(), expected.error());
      EXPECT_NEAR(image.grey(), expected.grey(), 5 * error) << e.name << ", " << s << " m";
      EXPECT_LT(error, 0.03 * expected.grey()) << e.name;
    }
  }
}

}  // namespace
}  // namespace ninefold
