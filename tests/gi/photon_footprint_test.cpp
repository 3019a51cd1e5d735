// The share of a photon's disk that is surface, against areas from elementary geometry.
#include "common/gi/photons/photon_footprint.h"

#include <gtest/gtest.h>

#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

// Mean over turns of the pattern.
double footprint(SceneBuilder& b, Vec3 x, Vec3 n, Metres r) {
  b.camera(Vec3(0, 5, 0), Vec3(0, -1, 0), 1, Vec3(1, 0, 0));
  const Scene scene = b.build();
  const Tracer tracer(scene, Isa::automatic);
  const Transport transport(tracer, Settings{});
  constexpr int kTurns = 64;
  double sum = 0;
  RayCounts counts;
  ShadingPoint at;
  at.surface.position = x, at.surface.instance = ~0u, at.ng = n, at.front = true;
  for (int i = 0; i < kTurns; ++i)
    sum += double(photonFootprint(transport, at, r, static_cast<float>(i) / kTurns, counts));
  return sum / kTurns;
}

SceneBuilder square() {  // [-1, 1]^2 in y = 0, seen from above
  SceneBuilder b;
  b.quad(b.material(testing::matte(Vec3(0.5f))), Vec3(-1, 0, -1), Vec3(0, 0, 2), Vec3(2, 0, 0));
  return b;
}

TEST(PhotonFootprint, WholeInTheMiddleHalfAtAnEdgeAQuarterAtACorner) {
  SceneBuilder b = square();
  EXPECT_NEAR(footprint(b, Vec3(0), Vec3(0, 1, 0), 0.5f), 1, 1e-4);
  EXPECT_NEAR(footprint(b, Vec3(0.9999f, 0, 0), Vec3(0, 1, 0), 0.5f), 0.5, 0.02);
  EXPECT_NEAR(footprint(b, Vec3(0.9999f, 0, 0.9999f), Vec3(0, 1, 0), 0.5f), 0.25, 0.02);
}

// A strip of width 2a through a disk of radius r has area 2 (a sqrt(r^2 - a^2) + r^2 asin(a/r)).
TEST(PhotonFootprint, OfABoardNarrowerThanTheDisk) {
  SceneBuilder b;
  b.quad(b.material(testing::matte(Vec3(0.5f))), Vec3(-0.1f, 0, -3), Vec3(0, 0, 6),
         Vec3(0.2f, 0, 0));
  const double a = 0.1, r = 0.5;
  const double area = 2 * (a * std::sqrt(r * r - a * a) + r * r * std::asin(a / r));
  EXPECT_NEAR(footprint(b, Vec3(0), Vec3(0, 1, 0), 0.5f), area / (double(kPi) * r * r), 0.02);
}

// Receivers on a wall across a corner do not accept the photon; those on a slope of 45 degrees do
// as long as they are near its tangent plane, and they are longer than their shadow on the disk.
TEST(PhotonFootprint, WallsAcrossDoNotCountSlopesDo) {
  SceneBuilder wall = square();
  wall.quad(wall.material(testing::matte(Vec3(0.5f))), Vec3(0.1f, -1, -1), Vec3(0, 2, 0),
            Vec3(0, 0, 2));
  EXPECT_NEAR(footprint(wall, Vec3(0), Vec3(0, 1, 0), 0.5f), 1, 1e-4);

  SceneBuilder slope;  // y = |x|: seen from the photon at the bottom of the groove
  const int matte = slope.material(testing::matte(Vec3(0.5f)));
  slope.quad(matte, Vec3(0, 0, -1), Vec3(0, 0, 2), Vec3(1, 1, 0));
  slope.quad(matte, Vec3(-1, 1, -1), Vec3(0, 0, 2), Vec3(1, -1, 0));
  // Within the sphere each side holds a strip of half a disk, up to r/8 high, sqrt(2) r/8 wide.
  const double a = std::sqrt(2.0) / 8;
  EXPECT_NEAR(footprint(slope, Vec3(0), Vec3(0, 1, 0), 0.5f),
              2 * (a * std::sqrt(1 - a * a) + std::asin(a)) / double(kPi), 0.04);
}

// A sheet on a floor, a thousandth of r above it: the light that falls on the sheet is its alone.
TEST(PhotonFootprint, WhatLiesUnderASheetTakesNoShare) {
  SceneBuilder b = square();
  b.quad(b.material(testing::matte(Vec3(0.5f))), Vec3(-1, 5e-4f, -1), Vec3(0, 0, 2), Vec3(1, 0, 0));
  EXPECT_NEAR(footprint(b, Vec3(-0.5f, 5e-4f, 0), Vec3(0, 1, 0), 0.4f), 1, 1e-3);
  // Partly on the sheet, partly beside it: neither is lost.
  EXPECT_NEAR(footprint(b, Vec3(-0.1f, 5e-4f, 0), Vec3(0, 1, 0), 0.5f), 1, 1e-3);
  EXPECT_NEAR(footprint(b, Vec3(0.1f, 0, 0), Vec3(0, 1, 0), 0.5f), 1, 1e-3);
}

// A table over a floor, farther above it than r/8: each has its own light.
TEST(PhotonFootprint, ATableTakesNoShareOfTheFloor) {
  SceneBuilder b = square();
  const int matte = b.material(testing::matte(Vec3(0.5f)));
  b.box(matte, Vec3(-1, 0.1f, -1), Vec3(1, 0.11f, 1), false);
  EXPECT_NEAR(footprint(b, Vec3(0, 0.11f, 0), Vec3(0, 1, 0), 0.5f), 1, 1e-3);
  EXPECT_NEAR(footprint(b, Vec3(0), Vec3(0, 1, 0), 0.5f), 1, 1e-3);
}

// Water over the floor of a pool takes no share of the light that falls on the floor.
TEST(PhotonFootprint, ClearGlassAcceptsNothing) {
  SceneBuilder b = square();
  b.quad(b.material(testing::glass(1.33f)), Vec3(-1, 0.1f, -1), Vec3(0, 0, 2), Vec3(2, 0, 0));
  EXPECT_NEAR(footprint(b, Vec3(0), Vec3(0, 1, 0), 0.5f), 1, 1e-4);
}

}  // namespace
}  // namespace ninefold
