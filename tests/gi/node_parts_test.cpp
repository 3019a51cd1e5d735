// What stands on mesh elements: parts of nodes, their areas, and the light on either side.
#include "common/gi/elements/node_parts.h"

#include <gtest/gtest.h>

#include "common/gi/elements/scene_elements.h"
#include "common/sampling/sampler.h"
#include "common/sampling/warp.h"
#include "tests/gi/make_scene.h"
#include "tests/gi/render.h"
#include "tests/seeds.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

constexpr Metres kSize = 0.3f;

// A floor of side 2 in two triangles, the first instance, and what `add` puts on it.
Scene floorWith(const std::function<void(SceneBuilder&, int)>& add) {
  SceneBuilder b;
  const int grey = b.material(testing::matte(Vec3(0.7f)));
  b.quad(grey, Vec3(-1, 0, 1), Vec3(2, 0, 0), Vec3(0, 0, -2));
  add(b, grey);
  return b.build();
}

// Parts of the floor's face that points lie in, by a regular pattern; with the points.
struct Seen {
  std::vector<Vec3> points;
  std::vector<PartPlace> places;
};

Seen lookAtFloor(const Tracer& tracer, const SceneElements& elements, uint32_t rows = 97) {
  Seen seen;
  const Tracer::Corners corners[2] = {tracer.corners(0, 0), tracer.corners(0, 1)};
  for (uint32_t triangle = 0; triangle < 2; ++triangle)
    forEachMiddle(rows, [&](const std::array<float, 3>& w) {
      const Tracer::Corners& at = corners[triangle];
      seen.points.push_back(w[0] * at.a + w[1] * at.b + w[2] * at.c);
      seen.places.push_back(elements.at(tracer, {0, triangle, false}, w[1], w[2]));
    });
  return seen;
}

TEST(NodeParts, AreTheFacesOfNodesWhereNothingStands) {
  const Scene scene = floorWith([](SceneBuilder& b, int grey) {
    b.box(grey, Vec3(-0.4f, 0.1f, -0.4f), Vec3(0.4f, 0.5f, 0.4f), false);  // floats
  });
  const Tracer tracer(scene, Isa::automatic);
  const SceneElements elements(StillScene(tracer, nullptr), kSize, nullptr);
  EXPECT_EQ(elements.parts(0).size(), 2 * elements.block(0).nodes());
  for (uint32_t n = 0; n < elements.block(0).nodes(); ++n)
    for (uint32_t face = 0; face < 2; ++face)
      EXPECT_NEAR(elements.parts(0).area(2 * n + face), elements.block(0).area(n), 1e-5f);
}

// No part has points on both sides of a wall, wherever it stands: along the nodes, between them,
// askew, thin or thick.
TEST(NodeParts, AreOnOneSideOfAWall) {
  for (const float angle : {0.0f, 0.3f, 0.785398f})
    for (const float shift : {0.0f, 0.05f, 0.1f})
      for (const float thickness : {0.0f, 0.07f}) {
        const Vec3 along(std::sin(angle), 0, -std::cos(angle)),
            across(std::cos(angle), 0, std::sin(angle));
        const Scene scene = floorWith([&](SceneBuilder& b, int grey) {
          for (const float side : {0.0f, thickness})
            b.quad(grey, (shift + side) * across - 2.0f * along, 4.0f * along, Vec3(0, 1, 0));
        });
        const Tracer tracer(scene, Isa::automatic);
        const SceneElements elements(StillScene(tracer, nullptr), kSize, nullptr);
        const Seen seen = lookAtFloor(tracer, elements);
        std::vector<std::array<double, 2>> weightOf(elements.parts(0).size(), {0, 0});
        for (size_t i = 0; i < seen.points.size(); ++i) {
          const float x = glm::dot(seen.points[i], across) - shift;
          if (x > -1e-4f && x < thickness + 1e-4f) continue;
          for (size_t c = 0; c < 3; ++c)
            weightOf[seen.places[i].parts[c]][x > 0] +=
                static_cast<double>(seen.places[i].weights[c]);
        }
        double wrong = 0;
        for (const auto& [left, right] : weightOf) wrong += std::min(left, right);
        EXPECT_LT(wrong, 0.003 * static_cast<double>(seen.points.size()))
            << "angle " << angle << ", at " << shift << ", thick " << thickness;
      }
}

// Light that falls evenly onto what a box leaves of the floor is the same everywhere on it.
TEST(NodeParts, LeaveOutWhatABoxCovers) {
  for (const auto& [low, high] : {std::pair(Vec3(-0.31f, 0, -0.22f), Vec3(0.28f, 0.4f, 0.3f)),
                                  std::pair(Vec3(0.1f, -0.01f, 0.1f), Vec3(0.17f, 0.4f, 0.2f)),
                                  std::pair(Vec3(-0.5f, 1e-4f, -0.5f), Vec3(0.1f, 0.02f, 0.1f))}) {
    const Scene scene =
        floorWith([&](SceneBuilder& b, int grey) { b.box(grey, low, high, false); });
    const Tracer tracer(scene, Isa::automatic);
    const SceneElements elements(StillScene(tracer, nullptr), kSize, nullptr);
    const Seen seen = lookAtFloor(tracer, elements, 300);
    std::vector<double> light(elements.parts(0).size(), 0);
    const double share = 4.0 / static_cast<double>(seen.points.size());
    const auto isUnder = [&](Vec3 p) {
      return p.x > low.x && p.x < high.x && p.z > low.z && p.z < high.z;
    };
    for (size_t i = 0; i < seen.points.size(); ++i)
      for (size_t c = 0; c < 3 && !isUnder(seen.points[i]); ++c)
        light[seen.places[i].parts[c]] += share * static_cast<double>(seen.places[i].weights[c]);
    double worst = 0, square = 0, count = 0;
    for (size_t i = 0; i < seen.points.size(); ++i) {
      if (isUnder(seen.points[i])) continue;
      double e = 0;
      for (size_t c = 0; c < 3; ++c) {
        const uint32_t part = seen.places[i].parts[c];
        e += static_cast<double>(seen.places[i].weights[c]) * light[part] /
             static_cast<double>(elements.parts(0).area(part));
      }
      worst = std::max(worst, std::abs(e - 1)), square += (e - 1) * (e - 1), ++count;
    }
    EXPECT_LT(worst, 0.25) << low.x;
    EXPECT_LT(std::sqrt(square / count), 0.03) << low.x;
  }
}

// Mean over the frames of what a floor shows under a camera that looks straight down.
double seenFrom(const Scene& scene, Settings s, int frames) {
  const Tracer tracer(scene, Isa::automatic);
  return testing::render(tracer, s, frames).grey();
}

Settings fineFor(Method method, const Scene& scene) {
  Settings s = testing::small(method, 8);
  s.photonPool = 73728, s.fieldPhotons = 65536, s.fieldDirections = 19, s.fieldDistances = 32;
  s.elementSize = kSize / scene.bounds.radius();
  return s;
}

// Two rooms that share a floor, one of them lit: right at the wall, in the other one, it is dark.
TEST(NodeParts, NoLightLeaksUnderAWall) {
  for (const Method method : {Method::selective, Method::intersectionField})
    for (const float thickness : {0.0f, 0.05f}) {
      SceneBuilder b;
      const int grey = b.material(testing::matte(Vec3(0.7f)));
      b.box(grey, Vec3(-1), Vec3(1), true);
      for (const float x : {0.03f, 0.03f + thickness})
        b.quad(grey, Vec3(x, -1, -1), Vec3(0, 2, 0), Vec3(0, 0, 2));
      PunctualLight light;
      light.position = Vec3(-0.5f, 0, 0), light.intensity = Vec3(2);
      b.light(light);
      const auto at = [&](float x) {
        return SceneBuilder(b).camera(Vec3(x, 0, 0), Vec3(x, -1, 0.01f), 0.08f).build();
      };
      const Scene lit = at(-0.07f), dark = at(0.13f + thickness);
      const double bright = seenFrom(lit, fineFor(method, lit), 2);
      EXPECT_GT(bright, 0.1);
      EXPECT_LT(seenFrom(dark, fineFor(method, dark), 2), 0.006 * bright) << thickness;
    }
}

// The foot of a box is as bright as the path tracer has it.
TEST(NodeParts, TheFloorAroundABoxIsNotDark) {
  SceneBuilder b;
  const int grey = b.material(testing::matte(Vec3(0.7f)));
  b.box(grey, Vec3(-1), Vec3(1), true);
  b.box(grey, Vec3(-0.37f, -1, -0.37f), Vec3(0.37f, -0.75f, 0.37f), false);
  b.quad(b.material(testing::matte(Vec3(0), Vec3(5))), Vec3(-0.3f, 0.99f, -0.3f), Vec3(0.6f, 0, 0),
         Vec3(0, 0, 0.6f));
  b.camera(Vec3(0.45f, 0.5f, 0), Vec3(0.45f, -1, 0.001f), 0.05f);
  const Scene scene = b.build();
  Settings truth = testing::small(Method::pathTrace, 8);
  const double wanted = seenFrom(scene, truth, 400);
  for (const Method method : {Method::selective, Method::intersectionField})
    EXPECT_NEAR(seenFrom(scene, fineFor(method, scene), 8), wanted, 0.03 * wanted);
}

}  // namespace
}  // namespace ninefold
