// The surface at a hit: position, both normals, tangent, under instancing, scaling and mirroring.
#include "common/tracing/surface.h"

#include <gtest/gtest.h>

#include "common/tracing/tracer.h"
#include "tests/tracing/make_scene.h"

namespace ninefold {
namespace {

void expectNear(Vec3 a, Vec3 b, float tolerance) {
  EXPECT_LT(glm::length(a - b), tolerance)
      << a.x << " " << a.y << " " << a.z << " / " << b.x << " " << b.y << " " << b.z;
}

DMat4 randomAffine(Dice& dice) {
  DMat4 m(1);
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 3; ++row) m[column][row] = dice.uniform(-2, 2);
  return m;
}

// A sphere-like cube: its vertex normals point away from the centre.
Mesh roundCube() {
  Mesh mesh = cube();
  for (const Vec3& p : mesh.positions) mesh.normals.push_back(glm::normalize(p));
  return mesh;
}

TEST(Surface, LiesOnTheRayThatFoundItWithinItsErrorBound) {
  Dice dice(1);
  for (int round = 0; round < 200; ++round) {
    Scene scene = sceneOf({cube()});
    scene.instances[0].toWorld = randomAffine(dice);
    const Vec3 centre(scene.instances[0].toWorld[3]);
    const Tracer tracer(scene, Isa::automatic);
    for (int i = 0; i < 50; ++i) {
      const Vec3 direction = dice.direction();
      const Hit hit = tracer.closest(centre, direction, kFar);
      if (!hit) continue;  // flattened to nothing
      const SurfacePoint p = tracer.surface(hit);
      expectNear(p.position, centre + hit.t * direction, 1e-4f * (1 + hit.t));
      const Tracer::Corners at = tracer.corners(hit.instance, hit.triangle);
      const DVec3 n =
          glm::normalize(glm::cross(DVec3(at.b) - DVec3(at.a), DVec3(at.c) - DVec3(at.a)));
      EXPECT_LE(std::abs(glm::dot(DVec3(p.position) - DVec3(at.a), n)), p.error);
    }
  }
}

TEST(Surface, FrontsStayFrontsUnderAnyTransformMirrorsIncluded) {
  Dice dice(2);
  int mirrored = 0;
  for (int round = 0; round < 500; ++round) {
    Scene scene = sceneOf({roundCube()});
    const DMat4 toWorld = randomAffine(dice);
    const double det = glm::determinant(DMat3(toWorld));
    if (std::abs(det) < 0.05) continue;
    mirrored += det < 0;
    scene.instances[0].toWorld = toWorld;
    const Vec3 centre(toWorld[3]);
    const Tracer tracer(scene, Isa::automatic);
    for (int i = 0; i < 20; ++i) {
      const Vec3 outwards = dice.direction();
      const SurfacePoint p = tracer.surface(tracer.closest(centre, outwards, kFar));
      EXPECT_GT(glm::dot(p.geometricNormal, outwards), 0);
      EXPECT_GT(glm::dot(p.shadingNormal, p.geometricNormal), 0);
      EXPECT_NEAR(glm::length(p.geometricNormal), 1, 1e-6f);
      EXPECT_NEAR(glm::length(p.shadingNormal), 1, 1e-6f);
    }
  }
  EXPECT_GT(mirrored, 100);
}

TEST(Surface, ShadingNormalsTurnWithTheInverseTranspose) {
  Dice dice(3);
  Scene scene = sceneOf({roundCube()});
  scene.instances[0].toWorld =
      DMat4(DVec4(3, 0, 0, 0), DVec4(0, 1, 0, 0), DVec4(0, 0, 0.5, 0), DVec4(0, 0, 0, 1));
  const Tracer tracer(scene, Isa::automatic);
  for (int i = 0; i < 200; ++i) {
    const SurfacePoint p = tracer.surface(tracer.closest(Vec3(0), dice.direction(), kFar));
    const Vec3 local =
        p.position / Vec3(3, 1, 0.5f);  // interpolated normals of a cube run with the position
    expectNear(p.shadingNormal, glm::normalize(local / Vec3(3, 1, 0.5f)), 1e-3f);
  }
}

TEST(Surface, ShadingNormalsThatPointBackwardsAreTurnedToTheFront) {
  Mesh wrong = square();
  wrong.normals.assign(4, Vec3(0, 0.6f, -0.8f));
  const Scene scene = sceneOf({wrong});
  const SurfacePoint p = Tracer(scene, Isa::automatic).surface({0, 0, 0.2f, 0.2f, 1});
  expectNear(p.geometricNormal, {0, 0, 1}, 1e-6f);
  expectNear(p.shadingNormal, {0, -0.6f, 0.8f}, 1e-6f);
}

// Green in a normal map is up in the image: seen from the front, with the image upright, the
// tangent points right and the bitangent up. Mirroring the instance or the texture turns one of
// them.
TEST(Surface, TangentFrameFollowsTheImageOnTheWall) {
  const auto bitangent = [](const SurfacePoint& p) {
    return p.tangentSign * glm::cross(p.shadingNormal, p.tangent);
  };
  Scene scene = sceneOf({square()});
  SurfacePoint p = Tracer(scene, Isa::automatic).surface({0, 0, 0.3f, 0.3f, 1});
  expectNear(p.tangent, {1, 0, 0}, 1e-6f);
  expectNear(bitangent(p), {0, 1, 0}, 1e-6f);

  for (Vec2& uv : scene.meshes[0].uv0) uv.x = 1 - uv.x;
  p = Tracer(scene, Isa::automatic).surface({0, 0, 0.3f, 0.3f, 1});
  expectNear(p.tangent, {-1, 0, 0}, 1e-6f);
  expectNear(bitangent(p), {0, 1, 0}, 1e-6f);

  scene.meshes[0].tangents.assign(4, Vec4(-1, 0, 0, -1));
  const SurfacePoint given = Tracer(scene, Isa::automatic).surface({0, 0, 0.3f, 0.3f, 1});
  expectNear(given.tangent, p.tangent, 1e-6f);
  EXPECT_EQ(given.tangentSign, p.tangentSign);

  for (const bool withTangents : {true, false}) {
    if (!withTangents) scene.meshes[0].tangents.clear();
    scene.instances[0].toWorld =
        DMat4(DVec4(1, 0, 0, 0), DVec4(0, -1, 0, 0), DVec4(0, 0, 1, 0), DVec4(0, 0, 0, 1));
    p = Tracer(scene, Isa::automatic).surface({0, 0, 0.3f, 0.3f, 1});
    expectNear(p.geometricNormal, {0, 0, 1}, 1e-6f);
    expectNear(p.tangent, {-1, 0, 0}, 1e-6f);
    expectNear(bitangent(p), {0, -1, 0}, 1e-6f);
  }
}

TEST(Surface, WithoutTextureCoordinatesTheTangentIsStillAUnitVectorInThePlane) {
  Dice dice(4);
  const Scene scene = sceneOf({randomTriangles(dice, 100, 1, 1)});
  const Tracer tracer(scene, Isa::automatic);
  for (uint32_t triangle = 0; triangle < 100; ++triangle) {
    const SurfacePoint p = tracer.surface({0, triangle, 0.2f, 0.5f, 1});
    EXPECT_NEAR(glm::length(p.tangent), 1, 1e-5f);
    EXPECT_NEAR(glm::dot(p.tangent, p.shadingNormal), 0, 1e-5f);
  }
}

TEST(Surface, InterpolatesBothTextureCoordinates) {
  Mesh mesh = square();
  for (const Vec2& uv : mesh.uv0) mesh.uv1.push_back(3.0f * uv);
  const Scene scene = sceneOf({mesh});
  const Tracer tracer(scene, Isa::automatic);
  const SurfacePoint p = tracer.surface(tracer.closest({0.5f, 0.25f, 1}, {0, 0, -1}, kFar));
  EXPECT_NEAR(p.uv0.x, 0.75f, 1e-6f);
  EXPECT_NEAR(p.uv0.y, 0.375f, 1e-6f);
  EXPECT_NEAR(p.uv1.x, 2.25f, 1e-5f);
  EXPECT_NEAR(p.uv1.y, 1.125f, 1e-5f);
}

}  // namespace
}  // namespace ninefold
