// An intersection field with as many lines as published, 76 x 127 x 76 x 127, in four groups: what
// tests/gi holds of smaller ones.
#include <gtest/gtest.h>

#include "common/gi/intersection_field/intersection_field.h"
#include "common/scene/reader.h"
#include "common/scene/world.h"
#include "tests/gi/line_rays.h"
#include "tests/gi/render.h"

namespace ninefold {
namespace {

constexpr int kDirections = 76, kDistances = 127;

Scene cornell() { return readScene(NINEFOLD_SCENES "/cornell.glb"); }

TEST(FullField, HasTheHitsThatRaysFind) {
  const Scene scene = cornell();
  const Tracer tracer(scene, Isa::automatic);
  const LineField field(LineGrid(scene.bounds, kDirections, kDistances), scene, nullptr);
  const testing::LineCounts counts = testing::heldAgainstRays(field, tracer, 1009);
  EXPECT_GT(counts.all, 300000u);
  EXPECT_LT(counts.unlike, counts.all / 500) << "of " << counts.all;
}

// Lines stand for the area of what they meet, and for all directions: sum of mu = pi A.
TEST(FullField, HasTheMeasureOfTheSurfaces) {
  const Scene scene = cornell();
  const LineField field(LineGrid(scene.bounds, kDirections, kDistances), scene, nullptr);
  for (uint32_t i = 0; i < field.instances(); ++i) {
    double measure = 0, area = 0;
    field.local(i).forEachRun([&](GridLine line, uint32_t r) {
      const LineRun& run = field.local(i).runs()[r];
      line.m = run.first;
      measure += run.count * field.grid().measureOf(line);
    });
    const Mesh& mesh = scene.meshes[static_cast<size_t>(scene.instances[i].mesh)];
    for (const Triangle& t : mesh.triangles) {
      const auto corner = [&](uint32_t v) {
        return worldPoint(scene.instances[i].toWorld, mesh.positions[v]);
      };
      const Vec3 a = corner(t.x);
      area += 0.5 * double{glm::length(glm::cross(corner(t.y) - a, corner(t.z) - a))};
    }
    EXPECT_NEAR(measure / (double{kPi} * area), 1, 0.01) << i;
  }
}

// Both ways of direct light, against virtual lights: the mean, and pixel by pixel. The lamp itself
// is left out: at its edge a pixel is as bright as its few places on the film say.
TEST(FullField, ShowsWhatVirtualLightsShow) {
  const Scene scene = cornell();
  const Tracer tracer(scene, Isa::automatic);
  Settings truth = testing::small(Method::instantRadiosity, 32);
  truth.directVpls = 16, truth.indirectVpls = 64;
  const auto wanted = testing::render(tracer, truth, 96);
  for (const FieldDirect direct : {FieldDirect::vpls, FieldDirect::field}) {
    Settings s = testing::small(Method::intersectionField, 32);
    s.directVpls = 16, s.fieldPhotons = 65536, s.fieldDirect = direct;
    s.fieldDirections = kDirections, s.fieldDistances = kDistances;
    const auto found = testing::render(tracer, s, 16);
    double all = 0, sum = 0, squares = 0;
    for (size_t i = 0; i < found.pixels.size(); ++i) {
      const double a = double{found.pixels[i].y}, b = double{wanted.pixels[i].y};
      if (std::max(a, b) > 1) continue;
      ++all, sum += a - b, squares += (a - b) * (a - b);
    }
    EXPECT_GT(all, 900);
    EXPECT_LT(std::abs(sum / all), 0.01 * wanted.grey());
    EXPECT_LT(std::sqrt(squares / all), 0.12 * wanted.grey());
  }
}

}  // namespace
}  // namespace ninefold
