// Surfaces that lie in one another: which of them a ray hits, and what it learns of the others.
#include <gtest/gtest.h>

#include <random>

#include "common/tracing/tracer.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

struct Block {
  Vec3 low, high;
  float index;  // 0: opaque
};

// Blocks turned by the same arbitrary rotation, so that no coordinate is a round number.
Scene blocks(const std::vector<Block>& all, bool turned) {
  SceneBuilder b;
  for (const Block& block : all)
    b.box(b.material(block.index == 0 ? testing::matte(Vec3(0.5f)) : testing::glass(block.index)),
          block.low, block.high, false);
  Scene scene = b.build();
  if (!turned) return scene;
  const DVec3 x = glm::normalize(DVec3(0.8, 0.3, -0.4));
  const DVec3 y = glm::normalize(glm::cross(DVec3(0.1, 0.2, 1), x)), z = glm::cross(x, y);
  for (Instance& i : scene.instances)
    i.toWorld = DMat4(DVec4(x, 0), DVec4(y, 0), DVec4(z, 0), DVec4(0.1, -0.7, 0.3, 1));
  return scene;
}

Vec3 place(const Scene& scene, Vec3 p) {
  return Vec3(DVec3(scene.instances[0].toWorld * DVec4(DVec3(p), 1.0)));
}

// Rays from within the first block down to its face y = 0; calls check(surface).
template <typename Check>
void lookDown(const Scene& scene, Check&& check) {
  const Tracer tracer(scene, Isa::automatic);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(-0.9f, 0.9f);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 from = place(scene, Vec3(uniform(random), 0.5f, uniform(random)));
    const Vec3 to = place(scene, Vec3(uniform(random), 0, uniform(random)));
    const Hit hit = tracer.closest(from, glm::normalize(to - from), 10);
    ASSERT_TRUE(hit);
    check(tracer.surface(hit));
  }
}

const Block kGlass{Vec3(-1, 0, -1), Vec3(1, 1, 1), 1.5f};
const Block kTable{Vec3(-2, -1, -2), Vec3(2, 0, 2), 0};
const Block kWater{Vec3(-1, -1, -1), Vec3(1, 0, 1), 1.33f};

TEST(Contacts, GlassOnATableEndsAtTheTable) {
  for (const bool turned : {false, true})
    lookDown(blocks({kGlass, kTable}, turned), [](const SurfacePoint& p) {
      ASSERT_EQ(p.instance, 1u);
      ASSERT_EQ(p.contactCount, 1);
      EXPECT_EQ(p.contacts[0].material, 0);
      EXPECT_FALSE(p.contacts[0].sameSide);  // the table looks up, the glass down
    });
}

TEST(Contacts, SolidsInContactNameEachOther) {
  for (const bool turned : {false, true})
    lookDown(blocks({kGlass, kWater}, turned), [](const SurfacePoint& p) {
      ASSERT_EQ(p.instance, 1u);  // the one that shows its front, always
      ASSERT_EQ(p.contactCount, 1);
      EXPECT_EQ(p.contacts[0].material, 0);
      EXPECT_FALSE(p.contacts[0].sameSide);
    });
}

// New rays start outside both planes: whichever side they are to go to.
TEST(Contacts, NewRaysMeetNeitherSurfaceAgain) {
  for (const bool turned : {false, true}) {
    const Scene scene = blocks({kGlass, kWater}, turned);
    const Tracer tracer(scene, Isa::automatic);
    const Vec3 down = glm::normalize(place(scene, Vec3(0.1f, -1, 0.2f)) - place(scene, Vec3(0)));
    lookDown(scene, [&](const SurfacePoint& p) {
      for (const Vec3 w : {down, -down}) EXPECT_FALSE(tracer.occluded(offsetOrigin(p, w), w, 0.5f));
    });
  }
}

TEST(Contacts, OfOneMeshCountIfTheyLookApart) {
  // Two glass blocks in one mesh share the face y = 0; a triangle that is there twice does not.
  SceneBuilder b;
  const int glass = b.material(testing::glass(1.5f));
  b.box(glass, kGlass.low, kGlass.high, false).box(glass, kWater.low, kWater.high, false);
  Scene scene = b.build();
  Mesh& first = scene.meshes[0];
  const Mesh second = scene.meshes[1];
  const auto shift = static_cast<uint32_t>(first.positions.size());
  first.positions.insert(first.positions.end(), second.positions.begin(), second.positions.end());
  for (const Triangle& t : second.triangles) first.triangles.push_back(t + shift);
  first.triangles.push_back(first.triangles[0]);
  scene.instances.pop_back();
  lookDown(scene, [](const SurfacePoint& p) {
    ASSERT_EQ(p.contactCount, 1);
    EXPECT_FALSE(p.contacts[0].sameSide);
  });
  const Tracer tracer(scene, Isa::automatic);
  const Hit side = tracer.closest(Vec3(5, 0.5f, 0.2f), Vec3(-1, 0, 0), 10);
  EXPECT_EQ(tracer.surface(side).contactCount, 0);
}

TEST(Contacts, EndWhereOneOfTheSurfacesEnds) {
  const Block stone{Vec3(-0.5f, -1, -0.5f), Vec3(0.5f, 0, 0.5f), 0};
  lookDown(blocks({kGlass, stone}, false), [](const SurfacePoint& p) {
    const bool over = std::abs(p.position.x) < 0.499f && std::abs(p.position.z) < 0.499f;
    const bool beside = std::abs(p.position.x) > 0.501f || std::abs(p.position.z) > 0.501f;
    if (over) {
      ASSERT_EQ(p.instance, 1u);
    }
    if (beside) {
      ASSERT_EQ(p.instance, 0u);
      EXPECT_EQ(p.contactCount, 0);
    }
  });
}

TEST(Contacts, AreNotThereAcrossAGap) {
  const Block below{Vec3(-1, -1, -1), Vec3(1, -1e-4f, 1), 1.33f};
  lookDown(blocks({kGlass, below}, true),
           [](const SurfacePoint& p) { EXPECT_EQ(p.contactCount, 0); });
}

// A lamp in the plane of a ceiling is seen, from below; from above there is the ceiling's back.
TEST(Contacts, LampsInAPlaneAreSeenFromTheirFront) {
  for (const bool lampFirst : {false, true}) {
    SceneBuilder b;
    const int wall = b.material(testing::matte(Vec3(0.5f)));
    const int lamp = b.material(testing::matte(Vec3(0), Vec3(1)));
    const auto ceiling = [&](int material, float half) {
      b.quad(material, Vec3(-half, 1, -half), Vec3(2 * half, 0, 0), Vec3(0, 0, 2 * half));
    };
    if (lampFirst) ceiling(lamp, 0.3f);
    ceiling(wall, 1);
    if (!lampFirst) ceiling(lamp, 0.3f);
    const Scene scene = b.build();
    const Tracer tracer(scene, Isa::automatic);
    const auto seen = [&](Vec3 from, Vec3 to) {
      const Hit hit = tracer.closest(from, glm::normalize(to - from), 10);
      return scene.meshes[hit.instance].material;
    };
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(-0.29f, 0.29f);
    for (int i = 0; i < 1000; ++i) {
      const Vec3 to(uniform(random), 1, uniform(random));
      EXPECT_EQ(seen(Vec3(uniform(random), 0, 0.1f), to), lamp);
      EXPECT_EQ(seen(Vec3(0.4f, 0, 0.1f), to + Vec3(0.6f, 0, 0)), wall);
    }
  }
}

// Two squares back to back: each side sees the one that faces it.
TEST(Contacts, BackToBackTheFrontIsSeen) {
  SceneBuilder b;
  const int red = b.material(testing::matte(Vec3(0), Vec3(1, 0, 0)));
  const int blue = b.material(testing::matte(Vec3(0), Vec3(0, 0, 1)));
  b.quad(red, Vec3(-1, 0, 1), Vec3(2, 0, 0), Vec3(0, 0, -2));   // up
  b.quad(blue, Vec3(-1, 0, -1), Vec3(2, 0, 0), Vec3(0, 0, 2));  // down
  const Scene scene = b.build();
  const Tracer tracer(scene, Isa::automatic);
  for (const float x : {-0.7f, -0.1f, 0.3f, 0.9f}) {
    EXPECT_EQ(tracer.closest(Vec3(x, 1, 0.2f), Vec3(0, -1, 0), 10).instance, 0u);
    EXPECT_EQ(tracer.closest(Vec3(x, -1, 0.2f), Vec3(0, 1, 0), 10).instance, 1u);
  }
}

// Opaque surfaces among themselves are left alone: whichever is hit, nothing passes.
TEST(Contacts, OpaqueSurfacesNeedNone) {
  lookDown(blocks({{kGlass.low, kGlass.high, 0}, kTable}, false),
           [](const SurfacePoint& p) { EXPECT_EQ(p.contactCount, 0); });
}

}  // namespace
}  // namespace ninefold
