// Film positions to directions: what is left, right, up, down and how wide the view is.
#include "common/math/camera.h"

#include <gtest/gtest.h>

#include <random>

namespace ninefold {
namespace {

Camera tilted() {
  Camera camera;
  camera.forward = glm::normalize(Vec3(1, -0.5f, 2));
  camera.up = Vec3(0.1f, 3, 0);
  camera.verticalFov = 1.1f;
  return camera;
}

TEST(CameraRays, MiddleOfTheFilmLooksForward) {
  const Camera camera = tilted();
  const Vec3 d = CameraRays(camera, 640, 480).direction(320, 240);
  EXPECT_NEAR(glm::length(d - camera.forward), 0, 1e-6f);
}

TEST(CameraRays, EdgesOfTheFilmSpanTheFieldOfView) {
  const Camera camera = tilted();
  for (const int width : {480, 640, 1920}) {
    const CameraRays rays(camera, width, 480);
    const auto angle = [](Vec3 a, Vec3 b) {
      return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
    };
    const float middleX = static_cast<float>(width) / 2;
    EXPECT_NEAR(angle(rays.direction(middleX, 0), rays.direction(middleX, 480)), camera.verticalFov,
                1e-5f);
    const float horizontal =
        2 * std::atan(std::tan(camera.verticalFov / 2) * static_cast<float>(width) / 480);
    EXPECT_NEAR(angle(rays.direction(0, 240), rays.direction(static_cast<float>(width), 240)),
                horizontal, 1e-5f);
  }
}

TEST(CameraRays, RightIsRightAndDownIsDown) {
  const CameraRays rays(Camera{}, 64, 48);  // looks along -z, y up
  EXPECT_GT(rays.direction(60, 24).x, 0);
  EXPECT_LT(rays.direction(60, 24).z, 0);
  EXPECT_LT(rays.direction(32, 40).y, 0);
}

TEST(CameraRays, DirectionsAreUnitVectors) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<float> uniform(0, 640);
  const CameraRays rays(tilted(), 640, 640);
  for (int i = 0; i < 1000; ++i)
    ASSERT_NEAR(glm::length(rays.direction(uniform(engine), uniform(engine))), 1, 1e-6f);
}

TEST(CameraRays, FilmPositionsAreWhereTheirDirectionsCameFrom) {
  const CameraRays rays(tilted(), 640, 480);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(0, 1);
  for (int i = 0; i < 1000; ++i) {
    const Vec2 film(640 * uniform(random), 480 * uniform(random));
    const auto found = rays.filmPosition((0.1f + uniform(random)) * rays.direction(film.x, film.y));
    ASSERT_TRUE(found);
    EXPECT_NEAR(glm::length(*found - film), 0, 2e-3f);
  }
  EXPECT_FALSE(rays.filmPosition(-tilted().forward));
}

Camera orthographic() {
  Camera camera = tilted();
  camera.eye = Vec3(3, -2, 1), camera.orthographicHeight = 2.5f;
  return camera;
}

TEST(CameraRays, OrthographicRaysAreParallelAndSpanTheHeight) {
  const CameraRays rays(orthographic(), 640, 320);
  EXPECT_EQ(rays.direction(3, 5), orthographic().forward);
  EXPECT_EQ(rays.direction(600, 100), orthographic().forward);
  EXPECT_NEAR(glm::length(rays.start(320, 160)), 0, 1e-6f);
  EXPECT_NEAR(glm::length(rays.start(7, 0) - rays.start(7, 320)), 2.5f, 1e-5f);
  EXPECT_NEAR(glm::length(rays.start(0, 9) - rays.start(640, 9)), 5, 1e-5f);
  EXPECT_NEAR(glm::dot(rays.start(10, 20), orthographic().forward), 0, 1e-6f);
  const Vec3 right = glm::cross(orthographic().forward, orthographic().up);
  EXPECT_GT(glm::dot(rays.start(600, 20), right), 0);
  EXPECT_LT(glm::dot(rays.start(320, 300), orthographic().up), 0);
}

// A place on a ray is found where the ray came from, at its depth.
TEST(CameraRays, PlacesAtADepthLieOnTheirRays) {
  for (const Camera& camera : {tilted(), orthographic()}) {
    const CameraRays rays(camera, 640, 480);
    for (const Vec2 film : {Vec2(10, 20), Vec2(320, 240), Vec2(600.5f, 3)}) {
      const Vec3 start = rays.start(film.x, film.y), d = rays.direction(film.x, film.y);
      const Vec3 place = rays.atDepth(film.x, film.y, 4);
      EXPECT_NEAR(glm::dot(place, camera.forward), 4, 1e-5f);
      EXPECT_NEAR(glm::length(glm::cross(place - start, d)), 0, 1e-5f);
      EXPECT_NEAR(rays.depthOf(film.x, film.y, glm::length(place - start)), 4, 1e-5f);
      const auto found = rays.filmPosition(place);
      ASSERT_TRUE(found);
      EXPECT_NEAR(glm::length(*found - film), 0, 2e-3f);
    }
    EXPECT_FALSE(rays.filmPosition(-camera.forward));
  }
}

}  // namespace
}  // namespace ninefold
