// What every user of the Tracer may rely on: nothing leaks, all kinds of queries agree, twice is
// the same.
#include "common/tracing/tracer.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstring>

#include "common/base/error.h"
#include "tests/tracing/make_scene.h"

namespace ninefold {
namespace {

bool sameBits(const Hit& a, const Hit& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

TEST(Tracer, NoRayLeavesAClosedBox) {
  Dice dice(1);
  Scene box = sceneOf({cube()});
  box.instances[0].toWorld = DMat4(DVec4(2.3, 0.4, 0.1, 0), DVec4(-0.3, 1.7, 0.2, 0),
                                   DVec4(0.2, -0.5, 3.1, 0), DVec4(0.37, -0.11, 5.03, 1));
  const Mat3 linear(DMat3(box.instances[0].toWorld));
  const Vec3 centre(box.instances[0].toWorld[3]);
  const Tracer tracer(box, Isa::automatic);
  const std::vector<Vec3>& corners = box.meshes[0].positions;
  for (int i = 0; i < 300000; ++i) {
    const Vec3 origin = centre + linear * dice.inBox(0.99f);
    Vec3 direction = dice.direction();
    const auto pick = [&] { return centre + linear * corners[static_cast<size_t>(dice.below(8))]; };
    if (i % 3 == 1) direction = pick() - origin;  // at a corner
    if (i % 3 == 2)
      direction = glm::mix(pick(), pick(), dice.uniform(0, 1)) - origin;  // edges, diagonals
    ASSERT_TRUE(tracer.closest(origin, direction, kFar)) << i;
    ASSERT_TRUE(tracer.occluded(origin, direction, kFar)) << i;
  }
}

class AnyIsa : public testing::TestWithParam<Isa> {};

TEST_P(AnyIsa, PacketsSingleRaysAndOcclusionAgree) {
  Dice dice(2);
  const Scene scene = sceneOf({randomTriangles(dice, 200, 1, 0.4f), cube()});
  const Tracer tracer(scene, GetParam());
  for (int round = 0; round < 2000; ++round) {
    RayPacket rays, shadows;
    Vec3 origins[kPacket], directions[kPacket];
    float farT[kPacket];
    for (int i = 0; i < kPacket; ++i) {
      origins[i] = dice.inBox(1.5f), directions[i] = dice.direction(),
      farT[i] = dice.uniform(0.1f, 2);
      rays.set(i, origins[i], directions[i], 0, farT[i]);
      shadows.set(i, origins[i], directions[i], 0, farT[i]);
    }
    const auto active = static_cast<uint32_t>(dice.below(1 << kPacket));
    Hit hits[kPacket];
    std::fill_n(hits, kPacket, Hit{77, 77, 0, 0, 0});
    tracer.closest16(rays, active, hits);
    const uint32_t blocked = tracer.occluded16(shadows, active, round % 2 == 0);
    for (int i = 0; i < kPacket; ++i) {
      const bool traced = (active >> i & 1) != 0;
      const Hit single = tracer.closest(origins[i], directions[i], farT[i]);
      ASSERT_EQ((blocked >> i & 1) != 0, traced && bool(single)) << round << " " << i;
      ASSERT_EQ(tracer.occluded(origins[i], directions[i], farT[i]), bool(single));
      if (!traced) {
        ASSERT_EQ(hits[i].instance, 77u);
        continue;
      }
      ASSERT_EQ(hits[i].instance, single.instance) << round << " " << i;
      if (!single) continue;
      ASSERT_EQ(hits[i].triangle, single.triangle);
      ASSERT_NEAR(hits[i].t, single.t, 1e-5f);
      ASSERT_NEAR(hits[i].u, single.u, 1e-4f);
      ASSERT_NEAR(hits[i].v, single.v, 1e-4f);
    }
  }
}

TEST_P(AnyIsa, TwoTracersGiveTheSameBits) {
  Dice dice(3);
  const Scene scene = sceneOf({randomTriangles(dice, 3000, 1, 0.1f), cube()});
  const Tracer first(scene, GetParam()), second(scene, GetParam());
  EXPECT_EQ(first.isaName(), second.isaName());
  for (int round = 0; round < 3000; ++round) {
    RayPacket rays;
    for (int i = 0; i < kPacket; ++i) rays.set(i, dice.inBox(1), dice.direction(), 0, kFar);
    RayPacket again = rays;
    Hit hits[kPacket], hitsAgain[kPacket];
    first.closest16(rays, 0xffff, hits);
    second.closest16(again, 0xffff, hitsAgain);
    for (int i = 0; i < kPacket; ++i)
      ASSERT_TRUE(sameBits(hits[i], hitsAgain[i])) << round << " " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Tracer, AnyIsa, testing::Values(Isa::avx2, Isa::automatic));

TEST(Tracer, NamesTheInstructionSetThatRunsAndRefusesWhatTheMachineLacks) {
  const Scene scene = sceneOf({cube()});
  EXPECT_EQ(Tracer(scene, Isa::avx2).isaName(), "avx2");
  if (__builtin_cpu_supports("avx512vl")) {
    EXPECT_EQ(Tracer(scene, Isa::avx512).isaName(), "avx512");
  } else {
    EXPECT_THROW(Tracer(scene, Isa::avx512), Error);
  }
}

TEST(Tracer, TracksInstancesByTheirIndexAndFarEndsAreRespected) {
  Scene scene = sceneOf({square()});
  for (int i = 1; i < 5; ++i) {
    scene.instances.push_back(scene.instances[0]);
    scene.instances.back().toWorld[3] = DVec4(0, 0, -i, 1);
  }
  const Tracer tracer(scene, Isa::automatic);
  for (int i = 0; i < 5; ++i) {
    const Vec3 origin(0.2f, 0.1f, 0.5f - static_cast<float>(i));
    const Hit hit = tracer.closest(origin, {0, 0, -1}, kFar);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit.instance, static_cast<uint32_t>(i));
    EXPECT_FLOAT_EQ(hit.t, 0.5f);
    EXPECT_FALSE(tracer.closest(origin, {0, 0, -1}, 0.49f));
    EXPECT_FALSE(tracer.occluded(origin, {0, 0, -1}, 0.49f));
  }
}

TEST(Tracer, RaysThatAreNotFiniteHitNothingAndHarmNobody) {
  const Scene scene = sceneOf({cube()});
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinity = std::numeric_limits<float>::infinity();
  for (const Isa isa : {Isa::avx2, Isa::automatic}) {
    const Tracer tracer(scene, isa);
    for (const float bad : {nan, infinity, -infinity, 3e38f}) {
      for (int axis = 0; axis < 6; ++axis) {
        Vec3 origin(0), direction(0, 0, 1);
        (axis < 3 ? origin : direction)[axis % 3] = bad;
        EXPECT_FALSE(tracer.closest(origin, direction, kFar));
        EXPECT_FALSE(tracer.occluded(origin, direction, kFar));
        RayPacket rays;
        for (int i = 0; i < kPacket; ++i) rays.set(i, Vec3(0), {0, 0, 1}, 0, kFar);
        rays.set(5, origin, direction, 0, kFar);
        RayPacket shadows = rays;
        Hit hits[kPacket];
        tracer.closest16(rays, 0xffff, hits);
        for (int i = 0; i < kPacket; ++i) EXPECT_EQ(bool(hits[i]), i != 5);
        EXPECT_EQ(tracer.occluded16(shadows, 0xffff), 0xffffu & ~(1u << 5));
      }
    }
  }
}

TEST(Tracer, RefusesGeometryBeyondTheRangeOfItsArithmetic) {
  for (const double scale : {1e12, 1e30, 1e300}) {
    Scene scene = sceneOf({cube()});
    scene.instances[0].toWorld[0] *= scale;
    EXPECT_THROW(Tracer(scene, Isa::automatic), Error);
  }
}

TEST(Tracer, TakesFlatSlicesAndDegenerateTriangles) {
  Scene scene =
      sceneOf({cube(), meshOf({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, {{0, 1, 2}, {0, 0, 0}})});
  scene.instances[0].toWorld[2] = DVec4(0);
  const Tracer tracer(scene, Isa::automatic);
  EXPECT_TRUE(tracer.closest({0.3f, 0.2f, 1}, {0, 0, -1}, kFar));
  for (uint32_t triangle = 0; triangle < 2; ++triangle) {
    const SurfacePoint p = tracer.surface({1, triangle, 0.3f, 0.3f, 0});
    EXPECT_TRUE(isFinite(p.position) && isFinite(p.geometricNormal) && isFinite(p.tangent));
    EXPECT_TRUE(std::isfinite(p.error));
  }
}

}  // namespace
}  // namespace ninefold
