// The method intersection field: light that goes along lines ends up where light goes.
#include <gtest/gtest.h>

#include "tests/gi/expect.h"
#include "tests/gi/field_room.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

Settings smallField() { return testing::small(Method::intersectionField, 8); }

// Bounced light in the room, at lines of two resolutions, against the reference: the mean, and
// pixel by pixel.
TEST(IntersectionField, TendsToTheTruthWithMoreLines) {
  const Scene& scene = testing::fieldRoom();
  const Tracer tracer(scene, Isa::automatic);
  Settings truth = testing::small(Method::instantRadiosity, 16);
  truth.directVpls = 16, truth.indirectVpls = 64;
  const auto wanted = testing::render(tracer, truth, 192);
  const auto errorOf = [&](int directions, int distances) {
    Settings s = smallField();
    s.width = s.height = 16, s.directVpls = 16, s.fieldPhotons = 65536;
    s.fieldDirections = directions, s.fieldDistances = distances;
    const auto found = testing::render(tracer, s, 8);
    EXPECT_NEAR(found.grey(), wanted.grey(), (directions > 9 ? 0.03 : 0.08) * wanted.grey());
    double sum = 0;
    for (size_t i = 0; i < found.pixels.size(); ++i)
      sum += std::pow(double{found.pixels[i].x - wanted.pixels[i].x}, 2);
    return std::sqrt(sum / static_cast<double>(found.pixels.size())) / wanted.grey();
  };
  const double coarse = errorOf(5, 8), fine = errorOf(25, 48);
  EXPECT_LT(fine, 0.8 * coarse);
  EXPECT_LT(fine, 0.06);
}

// Things far smaller than the lines lie apart are lit and send light on all the same.
TEST(IntersectionField, SmallThingsSendLightByRays) {
  SceneBuilder b;
  b.box(b.material(testing::matte(Vec3(0.6f), Vec3(1))), Vec3(-1), Vec3(1), true);
  const int white = b.material(testing::matte(Vec3(0.8f)));
  for (int k = 0; k < 20; ++k) {
    const auto at = static_cast<float>(k) * 0.05f - 0.5f;
    b.box(white, Vec3(at, -0.4f, 0), Vec3(at + 0.01f, -0.39f, 0.01f), false);
  }
  const Scene scene = b.build();
  const Tracer tracer(scene, Isa::automatic);
  Settings s = smallField();
  s.fieldDirections = 9, s.fieldDistances = 14, s.camera = scene.cameras.front();
  const auto found = testing::render(tracer, s, 4);
  for (const Vec3& p : found.pixels) ASSERT_TRUE(isFinite(p));
  EXPECT_NEAR(found.grey(), 2.5, 0.1);
}

}  // namespace
}  // namespace ninefold
