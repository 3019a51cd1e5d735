// Direct light by the lines of a field: H without shadows is what plates send each other, V what
// part of a lamp can be seen.
#include "common/gi/intersection_field/lamp_visibility.h"

#include <gtest/gtest.h>

#include "tests/gi/closed_form.h"
#include "tests/gi/expect.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

Settings byLines(int directions = 19, int distances = 32) {
  Settings s = testing::small(Method::intersectionField, 8);
  s.fieldDirections = directions, s.fieldDistances = distances;
  s.fieldDirect = FieldDirect::field;
  s.pathLength = 1, s.elementSize = 0.06f;
  return s;
}

// A unit square that the whole picture shows, and what shines on it: form_factor_test.cpp.
SceneBuilder receiver() {
  SceneBuilder b;
  b.quad(b.material(testing::matte(Vec3(0.5f))), Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0));
  b.camera(Vec3(0.5f, 0.5f, 0.05f), Vec3(0.5f, 0.5f, 0), 2 * std::atan(10.0f));
  return b;
}

TEST(LampVisibility, WithoutShadowsIsTheFormFactor) {
  for (const float d : {0.5f, 1.0f, 3.0f}) {
    SceneBuilder b = receiver();
    b.quad(b.material(testing::matte(Vec3(0), Vec3(1))), Vec3(0, 0, d), Vec3(0, 1, 0),
           Vec3(1, 0, 0));
    const Scene scene = b.build();
    const Tracer tracer(scene, Isa::automatic);
    const double expected = 0.5 * testing::oppositeSquares(static_cast<double>(d));
    EXPECT_NEAR(testing::render(tracer, byLines(), 2).grey(), expected, 0.03 * expected) << d;
  }
}

// A screen half way hides one half of the lamp from the middle, and the picture's mean is that of
// the path tracer.
TEST(LampVisibility, FindsHalfShadows) {
  SceneBuilder b = receiver();
  b.quad(b.material(testing::matte(Vec3(0), Vec3(1))), Vec3(0, 0, 1), Vec3(0, 1, 0), Vec3(1, 0, 0));
  b.quad(b.material(testing::matte(Vec3(0))), Vec3(0.5f, -0.5f, 0.5f), Vec3(1, 0, 0),
         Vec3(0, 2, 0));
  const Scene scene = b.build();
  const Tracer tracer(scene, Isa::automatic);
  Settings truth = byLines();
  truth.method = Method::pathTrace;
  const auto wanted = testing::render(tracer, truth, 256);
  const auto found = testing::render(tracer, byLines(), 8);
  EXPECT_NEAR(found.grey(), wanted.grey(), 0.05 * wanted.grey());
  double coarse = 0, fine = 0;
  const auto sharper = testing::render(tracer, byLines(41, 64), 8);
  for (size_t i = 0; i < wanted.pixels.size(); ++i) {
    coarse += std::pow(double{found.pixels[i].x - wanted.pixels[i].x}, 2);
    fine += std::pow(double{sharper.pixels[i].x - wanted.pixels[i].x}, 2);
  }
  const double pixels = static_cast<double>(wanted.pixels.size());
  EXPECT_LT(std::sqrt(coarse / pixels), 0.15 * wanted.grey());
  EXPECT_LT(fine, coarse);
}

// A closed box around the lamp lets nothing out; a pane of a third of opacity two thirds.
TEST(LampVisibility, IsZeroBehindWallsAndDimmedBehindPanes) {
  const auto mean = [](const std::function<void(SceneBuilder&)>& add) {
    SceneBuilder b = receiver();
    b.quad(b.material(testing::matte(Vec3(0), Vec3(1))), Vec3(0.2f, 0.2f, 1), Vec3(0, 0.6f, 0),
           Vec3(0.6f, 0, 0));
    add(b);
    const Scene scene = b.build();
    const Tracer tracer(scene, Isa::automatic);
    return testing::render(tracer, byLines(), 4).grey();
  };
  const double open = mean([](SceneBuilder&) {});
  EXPECT_EQ(mean([](SceneBuilder& b) {
              b.box(b.material(testing::matte(Vec3(0.5f))), Vec3(0, 0, 0.8f), Vec3(1, 1, 1.2f),
                    true);
            }),
            0);
  const double dimmed = mean([](SceneBuilder& b) {
    Material pane = testing::matte(Vec3(0));
    pane.alphaMode = AlphaMode::blend, pane.opacity = 1 / 3.0f;
    b.quad(b.material(pane), Vec3(-1, -1, 0.5f), Vec3(3, 0, 0), Vec3(0, 3, 0));
  });
  EXPECT_NEAR(dimmed, open * 2 / 3, 0.05 * open);
}

// A lamp so small that no line meets it is asked by rays.
TEST(LampVisibility, AsksRaysWhereNoLinePasses) {
  SceneBuilder b = receiver();
  b.quad(b.material(testing::matte(Vec3(0), Vec3(10000))), Vec3(0.5f, 0.5f, 1), Vec3(0, 0.01f, 0),
         Vec3(0.01f, 0, 0));
  const Scene scene = b.build();
  const Tracer tracer(scene, Isa::automatic);
  Settings truth = byLines(5, 6);
  truth.method = Method::pathTrace;
  const auto found = testing::render(tracer, byLines(5, 6), 16);
  const auto wanted = testing::render(tracer, truth, 64);
  EXPECT_GT(found.rays.shadow, 1000u);
  EXPECT_NEAR(found.grey(), wanted.grey(), 0.02 * wanted.grey());
}

}  // namespace
}  // namespace ninefold
