// Rays that start on a surface never meet that surface, however large, small, thin or far away it
// is.
#include <gtest/gtest.h>

#include "common/math/rounding.h"
#include "common/tracing/tracer.h"
#include "tests/tracing/make_scene.h"

namespace ninefold {
namespace {

// Corners of triangles of all sizes, places and aspect ratios; some in axis-aligned planes.
Mesh awkwardTriangle(Dice& dice) {
  const float size = dice.magnitude(1e-4f, 1e6f);
  const float away = size * dice.magnitude(1e-2f, 1e3f);
  Vec3 at = away * dice.direction();
  Vec3 edge1 = size * dice.direction(), edge2 = size * dice.direction();
  const int kind = dice.below(5);
  if (kind == 1) edge2 = dice.uniform(-1, 2) * edge1 + dice.magnitude(1e-4f, 1e-1f) * edge2;
  if (kind == 2) edge2 = dice.magnitude(1e-4f, 1e-1f) * edge2;
  if (kind >= 3) edge1.y = edge2.y = 0;
  if (kind == 4) at.y = 0;
  return meshOf({at, at + edge1, at + edge2}, {{0, 1, 2}});
}

Vec3 barycentrics(Dice& dice) {
  const float root = std::sqrt(dice.uniform(0, 1)), u = dice.uniform(0, 1);
  return {1 - root, root * (1 - u), root * u};
}

// Uniform directions, and as many that graze the surface.
Vec3 leaving(Dice& dice, Vec3 normal) {
  const Vec3 d = dice.direction();
  if (dice.below(2) == 0) return d;
  const Vec3 along = d - glm::dot(d, normal) * normal;
  return glm::normalize(along + dice.magnitude(1e-6f, 1e-2f) * (dice.below(2) == 0 ? 1.0f : -1.0f) *
                                    normal);
}

TEST(RobustOrigin, AMillionRaysNeverMeetTheTriangleThatTheyStartFrom) {
  Dice dice(1);
  for (int scene = 0; scene < 4000; ++scene) {
    const Scene alone = sceneOf({awkwardTriangle(dice)});
    const Tracer tracer(alone, scene % 2 == 0 ? Isa::automatic : Isa::avx2);
    for (int point = 0; point < 16; ++point) {
      const Vec3 w = barycentrics(dice);
      const SurfacePoint p = tracer.surface({0, 0, w.y, w.z, 0});
      RayPacket packet;
      for (int lane = 0; lane < kPacket; ++lane) {
        const Vec3 direction = leaving(dice, p.geometricNormal);
        packet.set(lane, offsetOrigin(p, direction), direction, 0, kFar);
        ASSERT_FALSE(tracer.closest(offsetOrigin(p, direction), direction, kFar))
            << "scene " << scene << " point " << point << " lane " << lane;
      }
      ASSERT_EQ(tracer.occluded16(packet, 0xffff), 0u) << "scene " << scene << " point " << point;
    }
  }
}

TEST(RobustOrigin, PointsFoundByRaysFromFarAwayAreAsSafe) {
  Dice dice(2);
  for (int scene = 0; scene < 2000; ++scene) {
    const Scene alone = sceneOf({awkwardTriangle(dice)});
    const Tracer tracer(alone, Isa::automatic);
    const Tracer::Corners at = tracer.corners(0, 0);
    const float size = glm::length(at.b - at.a);
    for (int ray = 0; ray < 50; ++ray) {
      const Vec3 w = barycentrics(dice), d = dice.direction();
      const Vec3 origin =
          pointOnTriangle(at.a, at.b, at.c, w.y, w.z) - size * dice.magnitude(0.1f, 100) * d;
      const Hit hit = tracer.closest(origin, d, kFar);
      if (!hit) continue;
      const SurfacePoint p = tracer.surface(hit);
      const Vec3 next = leaving(dice, p.geometricNormal);
      ASSERT_FALSE(tracer.occluded(offsetOrigin(p, next), next, kFar)) << scene << " " << ray;
    }
  }
}

// A plane cut into many triangles: neighbours are as harmless as the triangle itself, except along
// directions so flat that the corners' own rounding makes the plane uneven.
TEST(RobustOrigin, NeighboursInTheSamePlaneAreNotMetEither) {
  Dice dice(3);
  constexpr int kSide = 16;
  for (int scene = 0; scene < 40; ++scene) {
    const Vec3 normal = dice.direction(),
               across = glm::normalize(glm::cross(normal, dice.direction()));
    const Vec3 along = glm::cross(normal, across),
               centre = dice.magnitude(0.01f, 100) * dice.direction();
    Mesh plane;
    for (int j = 0; j <= kSide; ++j)
      for (int i = 0; i <= kSide; ++i)
        plane.positions.push_back(centre + float(i) / kSide * across + float(j) / kSide * along);
    for (uint32_t j = 0; j < kSide; ++j)
      for (uint32_t i = 0; i < kSide; ++i) {
        const uint32_t at = j * (kSide + 1) + i, above = at + kSide + 1;
        plane.triangles.insert(plane.triangles.end(),
                               {{at, at + 1, above + 1}, {at, above + 1, above}});
      }
    const Scene flat = sceneOf({plane});
    const Tracer tracer(flat, Isa::automatic);
    for (int ray = 0; ray < 5000; ++ray) {
      const Vec3 w = barycentrics(dice);
      const auto triangle = static_cast<uint32_t>(dice.below(2 * kSide * kSide));
      const SurfacePoint p = tracer.surface({0, triangle, w.y, w.z, 0});
      const Vec3 d = dice.direction();
      if (std::abs(glm::dot(d, normal)) < 1e-3f) continue;
      ASSERT_FALSE(tracer.occluded(offsetOrigin(p, d), d, kFar)) << scene << " " << ray;
    }
  }
}

// Between two mutually visible points nothing is in the way, at whatever distance and angle.
TEST(RobustOrigin, SegmentsBetweenSurfacesAreBlockedByNeitherEnd) {
  Dice dice(4);
  int flat = 0;
  for (int scene = 0; scene < 2000; ++scene) {
    const Mesh from = awkwardTriangle(dice);
    Mesh to = awkwardTriangle(dice);
    const Scene pair = sceneOf({from, to});
    const Tracer tracer(pair, Isa::automatic);
    for (int ray = 0; ray < 50; ++ray) {
      const Vec3 wx = barycentrics(dice), wy = barycentrics(dice);
      const SurfacePoint x = tracer.surface({0, 0, wx.y, wx.z, 0});
      const SurfacePoint y = tracer.surface({1, 0, wy.y, wy.z, 0});
      const Vec3 d = y.position - x.position;
      const float far = y.error + kRayRounding * glm::length(d);
      const Vec3 start = offsetOrigin(x, d);
      const Vec3 end = offsetOrigin(y.position, y.geometricNormal, far, -d);
      // Flat along a plane, moving the ends may turn the segment over; no light goes there either.
      const auto turned = [&](Vec3 n) { return glm::dot(d, n) * glm::dot(end - start, n) <= 0; };
      if (turned(x.geometricNormal) || turned(y.geometricNormal)) {
        ++flat;
        continue;
      }
      RayPacket packet;
      packet.set(0, start, end - start, 0, 1);
      // Two triangles that cut each other may block; the ends' own planes may not.
      const Hit hit = tracer.closest(start, end - start, 1);
      const uint32_t blocked = tracer.occluded16(packet, 1);
      if (hit && hit.t > 1e-3f && hit.t < 0.999f) continue;
      ASSERT_FALSE(hit) << scene << " " << ray << " instance " << hit.instance << " t " << hit.t;
      ASSERT_EQ(blocked, 0u) << scene << " " << ray;
    }
  }
  EXPECT_LT(flat, 100000 / 10);
}

TEST(RobustOrigin, MovesByLessThanAHundredthOfAMillimetreInARoom) {
  Dice dice(5);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 at = dice.inBox(5);
    const Scene alone =
        sceneOf({meshOf({at, at + dice.direction(), at + dice.direction()}, {{0, 1, 2}})});
    const Tracer tracer(alone, Isa::automatic);
    const SurfacePoint p = tracer.surface({0, 0, 0.3f, 0.3f, 0});
    const Tracer::Corners c = tracer.corners(0, 0);
    if (glm::length(glm::cross(c.b - c.a, c.c - c.a)) < 0.3f) continue;  // slivers cost more
    EXPECT_LT(glm::length(offsetOrigin(p, p.geometricNormal) - p.position), 1e-5f);
  }
}

// Coordinates that are exactly zero round by nothing, and still the origin must leave the plane.
TEST(RobustOrigin, LeavesAPlaneWhoseCoordinateIsZero) {
  const Scene flat = sceneOf({square()});
  const Tracer tracer(flat, Isa::automatic);
  const SurfacePoint p = tracer.surface({0, 0, 0.25f, 0.25f, 0});
  for (const Vec3 d : {Vec3(0, 0, 1), Vec3(0.6f, 0, 0.8f), Vec3(0, 0.6f, -0.8f)})
    EXPECT_FALSE(tracer.occluded(offsetOrigin(p, d), d, 1e6f)) << d.x << " " << d.y << " " << d.z;
}

}  // namespace
}  // namespace ninefold
