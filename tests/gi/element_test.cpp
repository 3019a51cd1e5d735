// Mesh elements: nodes, areas, and light that falls onto them.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "common/base/error.h"
#include "common/gi/elements/element_light.h"
#include "common/gi/elements/packed_flux.h"
#include "common/gi/selective/group_pages.h"
#include "common/sampling/sampler.h"
#include "common/sampling/warp.h"
#include "tests/gi/make_scene.h"
#include "tests/gi/render.h"
#include "tests/seeds.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

float areaOf(const Mesh& mesh, size_t triangle) {
  const Triangle& t = mesh.triangles[triangle];
  const Vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
  return 0.5f * glm::length(glm::cross(b - a, c - a));
}

Scene roomAndBall(int rings) {
  SceneBuilder b;
  const int white = b.material(testing::matte(Vec3(0.5f)));
  b.box(white, Vec3(-1), Vec3(1), true);
  b.sphere(white, Vec3(0.2f), 0.3f, rings);
  return b.build();
}

TEST(ElementBlock, HasTheMeshesArea) {
  for (const int rings : {4, 40})
    for (const Metres size : {0.05f, 0.3f, 10.0f}) {
      const Scene scene = roomAndBall(rings);
      for (const Mesh& mesh : scene.meshes) {
        const ElementBlock block(scene, mesh, DMat3(1), size);
        double nodes = 0, area = 0;
        for (uint32_t i = 0; i < block.nodes(); ++i) nodes += static_cast<double>(block.area(i));
        for (size_t k = 0; k < mesh.triangles.size(); ++k) area += double{areaOf(mesh, k)};
        EXPECT_NEAR(nodes, area, 1e-4 * area);
      }
    }
}

// A square of side 2 cut into elements of sides 2/n has (n + 1)^2 nodes: its two triangles share
// those of their common edge. A box shares none across its edges.
TEST(ElementBlock, SharesNodesOnSmoothSurfacesAlone) {
  SceneBuilder b;
  const int white = b.material(testing::matte(Vec3(0.5f)));
  b.quad(white, Vec3(0), Vec3(2, 0, 0), Vec3(0, 2, 0)).box(white, Vec3(-1), Vec3(1), true);
  const Scene scene = b.build();
  for (const uint32_t n : {1u, 4u, 7u}) {
    const Metres size = 1.0001f * std::sqrt(8.0f) / static_cast<float>(n);
    const uint32_t all = (n + 1) * (n + 1);
    EXPECT_EQ(ElementBlock(scene, scene.meshes[0], DMat3(1), size).nodes(), all);
    EXPECT_EQ(ElementBlock(scene, scene.meshes[1], DMat3(1), size).nodes(), 6 * all);
  }
}

// A finely cut ball has about as many nodes as cells of side h touch it, not as many as vertices.
TEST(ElementBlock, PutsNodesOfFineMeshesTogether) {
  const Scene scene = roomAndBall(100);
  const size_t nodes = ElementBlock(scene, scene.meshes[1], DMat3(1), 0.1f).nodes();
  EXPECT_LT(nodes, 700u);
  EXPECT_GT(nodes, 100u);
}

// Light that falls evenly onto a surface is the same everywhere on it: weights of a point sum to
// one, and over a surface each node gets light in proportion to its area.
TEST(ElementBlock, SpreadsEvenLightInProportionToArea) {
  for (const Metres size : {0.11f, 0.4f}) {
    const Scene scene = roomAndBall(20);
    for (const Mesh& mesh : scene.meshes) {
      const ElementBlock block(scene, mesh, DMat3(1), size);
      std::vector<double> light(block.nodes(), 0);
      for (uint32_t k = 0; k < mesh.triangles.size(); ++k) {
        // The middles of K^2 alike triangles, much smaller than elements.
        const auto rows = static_cast<int>(20 * std::sqrt(areaOf(mesh, k)) / size) + 6;
        const float step = 1 / static_cast<float>(rows);
        const double share = double{areaOf(mesh, k)} / (rows * rows);
        for (int j = 0; j < rows; ++j)
          for (int i = 0; i < 2 * (rows - j) - 1; ++i) {
            const float third = i % 2 == 0 ? 1 / 3.0f : 2 / 3.0f;
            const ElementPlace at = block.at(k, step * (static_cast<float>(i / 2) + third),
                                             step * (static_cast<float>(j) + third));
            ASSERT_NEAR(at.weights[0] + at.weights[1] + at.weights[2], 1, 1e-5);
            for (size_t c = 0; c < 3; ++c) {
              ASSERT_GE(at.weights[c], 0);
              light[at.nodes[c]] += double{at.weights[c]} * share;
            }
          }
      }
      for (uint32_t i = 0; i < block.nodes(); ++i) {
        const double area = static_cast<double>(block.area(i));
        EXPECT_NEAR(light[i], area, 0.03 * area) << "node " << i << " of " << block.nodes();
      }
    }
  }
}

// A square whose triangles are there three times, the third time the other way round and from
// another corner: the nodes and areas of one, and each point is the same place on all.
TEST(ElementBlock, CountsATriangleOnceHoweverOftenItIsThere) {
  SceneBuilder b;
  b.quad(b.material(testing::matte(Vec3(0.5f))), Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0));
  Scene scene = b.build();
  const ElementBlock once(scene, std::as_const(scene).meshes[0], DMat3(1), 0.1f);
  Mesh& mesh = scene.meshes[0];
  const Triangle t = mesh.triangles[0];
  for (const Vec3& p : std::vector<Vec3>(mesh.positions)) mesh.positions.push_back(p);
  mesh.triangles.push_back(t + 4u);
  mesh.triangles.push_back({t.z, t.y, t.x});
  const ElementBlock thrice(scene, mesh, DMat3(1), 0.1f);
  EXPECT_EQ(thrice.nodes(), once.nodes());
  const float u = 0.3f, v = 0.45f, w = 1 - u - v;
  const ElementPlace first = thrice.at(0, u, v), second = thrice.at(2, u, v),
                     third = thrice.at(3, u, w);
  EXPECT_FALSE(second.isTurned);
  EXPECT_TRUE(third.isTurned);
  for (size_t c = 0; c < 3; ++c) {
    EXPECT_EQ(second.nodes[c], first.nodes[c]);
    EXPECT_EQ(third.nodes[c], first.nodes[c]);
    EXPECT_NEAR(third.weights[c], first.weights[c], 1e-5);
  }
}

// A square of which a texture leaves the left third: it has that area.
TEST(ElementBlock, HasNoAreaWhereTheMaterialHasHoles) {
  SceneBuilder b;
  Material leaf = testing::matte(Vec3(0.5f));
  leaf.alphaMode = AlphaMode::mask;
  b.quad(b.material(leaf), Vec3(0), Vec3(3, 0, 0), Vec3(0, 3, 0));
  Scene scene = b.build();
  TextureImage image{"leaf", 3, 1, 4, false, {255, 255, 255, 255, 0, 0, 0, 0, 0, 0, 0, 0}};
  scene.images.push_back(image);
  scene.materials[0].baseColorMap.image = 0, scene.materials[0].baseColorMap.nearest = true;
  scene.meshes[0].uv0 = {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
  for (const Metres size : {0.5f, 5.0f}) {
    const ElementBlock block(scene, std::as_const(scene).meshes[0], DMat3(1), size);
    double area = 0;
    for (uint32_t i = 0; i < block.nodes(); ++i) area += static_cast<double>(block.area(i));
    EXPECT_NEAR(area, 3, size < 1 ? 0.1 : 0.8);
  }
}

// Corners, edges and what rounding puts past the long side.
TEST(ElementBlock, FindsAPlaceForEachPointOfATriangle) {
  SceneBuilder b;
  b.quad(b.material(testing::matte(Vec3(0.5f))), Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0));
  const Scene scene = b.build();
  const ElementBlock block(scene, scene.meshes[0], DMat3(1), 0.1f);
  for (const Vec2& uv : {Vec2(0), Vec2(1, 0), Vec2(0, 1), Vec2(0.5f), Vec2(0.3f, 0.70001f),
                         Vec2(1.00001f, 0), Vec2(0.9999999f, 0.0000001f)}) {
    const ElementPlace at = block.at(1, uv.x, uv.y);
    float sum = 0;
    for (size_t c = 0; c < 3; ++c) {
      EXPECT_LT(at.nodes[c], block.nodes());
      EXPECT_GE(at.weights[c], 0);
      sum += at.weights[c];
    }
    EXPECT_NEAR(sum, 1, 1e-4);
  }
}

TEST(SceneElements, SayWhenTheyAreTooMany) {
  SceneBuilder b;
  const int white = b.material(testing::matte(Vec3(0.5f)));
  for (int i = 0; i < 12; ++i) b.quad(white, Vec3(0, 0, i), Vec3(1, 0, 0), Vec3(0, 1, 0));
  const Scene scene = b.build();
  const Tracer tracer(scene, Isa::automatic);
  const auto said = [&](Metres size) -> std::string {
    try {
      SceneElements(StillScene(tracer, nullptr), size, nullptr);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(said(0.01f), "");
  EXPECT_NE(said(0.0018f).find("corners of mesh elements: raise --element-size"),
            std::string::npos);
  EXPECT_NE(said(0.0001f).find("are too many: raise --element-size"), std::string::npos);
}

class Pool {
 public:
  Pool()
      : scene_(roomAndBall(12)),
        tracer_(std::as_const(scene_), Isa::automatic),
        surfaces_(std::make_shared<const SurfaceNumbers>(scene_)) {
    settings_ = testing::small(Method::selective);
    settings_.photonPool = 4608;
  }
  PhotonGroups groups() const { return PhotonGroups(settings_); }
  PhotonRow row(uint64_t seed) const {
    PhotonRow row{seed, 0, 1, 1.0f, {}, {}};
    for (uint64_t i = 0; i < 50; ++i) {
      const uint64_t word = hashWords(seed, i);
      const auto instance = static_cast<uint32_t>(word % 2);
      const auto triangles =
          static_cast<uint32_t>(std::as_const(scene_).meshes[instance].triangles.size());
      const Vec2 uv = squareToTriangle(Vec2(unitFloat(static_cast<uint32_t>(word >> 16)),
                                            unitFloat(static_cast<uint32_t>(word >> 32))));
      row.hits.push_back(
          {surfaces_->numberOf(
               {instance, static_cast<uint32_t>(word >> 8) % triangles, (word & 2) != 0}),
           static_cast<uint16_t>(65535 * uv.x), static_cast<uint16_t>(65535 * uv.y),
           packFlux(Flux(0.01f, 0.02f, 0.003f), hashWords(word, 1))});
    }
    return row;
  }
  std::shared_ptr<const ElementLight> digest(const StatePages& pages, const ElementLight* before,
                                             const StillScene& still) const {
    auto elements = sceneElements(still, 0.2f, before != nullptr ? before->elements() : nullptr);
    return std::make_shared<const ElementLight>(still.tracer(), pages, GroupPages(groups()),
                                                surfaces_, elements, ElementRule::linear, before);
  }
  std::shared_ptr<const ElementLight> digest(const StatePages& pages, const ElementLight* before,
                                             const Tracer& atRest) const {
    return digest(pages, before, StillScene(atRest, nullptr));
  }
  // All rows with light of their own.
  StatePages pages() const {
    const GroupPages rows(groups());
    StatePages pages;
    for (uint32_t g = 0; g < 306; ++g) pages.apply(rows.replace(pages, g, row(g)));
    return pages;
  }
  // E at many points of both sides.
  std::vector<Irradiance> look(const ElementLight& light, const Tracer& tracer) const {
    std::vector<Irradiance> seen;
    for (uint32_t instance = 0; instance < 2; ++instance)
      for (uint32_t k = 0; k < std::as_const(scene_).meshes[instance].triangles.size(); ++k)
        for (const bool isBack : {false, true})
          seen.push_back(light.at(tracer, {instance, k, isBack}, 0.3f, 0.2f));
    return seen;
  }
  const Scene& scene() const { return scene_; }
  const Tracer& tracer() const { return tracer_; }

 private:
  Scene scene_;
  Tracer tracer_;
  std::shared_ptr<const SurfaceNumbers> surfaces_;
  Settings settings_;
};

// Step by step or at once, with an object that moves meanwhile: the same to the last bit.
TEST(ElementLight, DigestedAtOnceIsDigestedStepByStep) {
  const Pool pool;
  const GroupPages rows(pool.groups());
  StatePages pages = pool.pages();
  auto light = pool.digest(pages, nullptr, pool.tracer());
  Scene moved = pool.scene();
  for (const uint64_t step : seedsFrom(1, 8)) {
    const Repeatable repeatable(step);
    for (uint64_t i = 0; i < 20; ++i) {
      const auto g = static_cast<uint32_t>(hashWords(step, i) % 306);
      pages.apply(rows.replace(pages, g, pool.row(hashWords(step, i, 1))));
    }
    // By and by through a wall.
    if (step % 2 == 0) moved.instances[1].toWorld[3].x += 0.1371;
    const Scene& now = moved;
    const Tracer after(pool.tracer(), now, {false, true}), late(now, Isa::automatic);
    light = pool.digest(pages, light.get(), after);
    const auto fresh = pool.digest(pages, nullptr, late);
    EXPECT_EQ(pool.look(*light, after), pool.look(*fresh, late));
  }
}

// What moves stands nowhere, so that nothing is looked at anew; and who comes late has the same,
// in a gesture, at rest after it, and in the next one.
TEST(ElementLight, InAGestureElementsStay) {
  const Pool pool;
  const GroupPages rows(pool.groups());
  StatePages pages = pool.pages();
  auto light = pool.digest(pages, nullptr, pool.tracer());
  Scene begun = pool.scene(), moved = pool.scene();
  for (uint64_t step = 0; step < 9; ++step) {
    for (uint64_t i = 0; i < 20; ++i) {
      const auto g = static_cast<uint32_t>(hashWords(step, i) % 306);
      pages.apply(rows.replace(pages, g, pool.row(hashWords(step, i, 1))));
    }
    const bool isFirst = step % 3 == 0, isLast = step % 3 == 2;
    if (isFirst) begun = moved;
    DMat4& place = moved.instances[1].toWorld;
    const DVec4 there = place[3] + DVec4(0.0371, 0, 0, 0);
    const double c = std::cos(0.3), s = std::sin(0.3);
    place =
        DMat4(DVec4(c, 0, -s, 0), DVec4(0, 1, 0, 0), DVec4(s, 0, c, 0), DVec4(0, 0, 0, 1)) * place;
    place[3] = there;
    const Scene &then = begun, &now = moved;
    const Tracer after(pool.tracer(), now, {false, true}), late(now, Isa::automatic);
    const StillScene still(after, &then), stillLate(late, &then);
    const auto next = pool.digest(pages, light.get(), still);
    const auto fresh = pool.digest(pages, nullptr, stillLate);
    EXPECT_EQ(pool.look(*next, still.tracer()), pool.look(*fresh, stillLate.tracer())) << step;
    for (uint32_t i = 0; i < 2 && !isFirst; ++i)
      EXPECT_TRUE(next->elements()->isShared(*light->elements(), i)) << "instance " << i;
    light = next;
    if (!isLast) continue;
    light = pool.digest(pages, light.get(), after);
    EXPECT_EQ(pool.look(*light, after), pool.look(*pool.digest(pages, nullptr, late), late))
        << step;
  }
}

// Both rules give each photon's flux to the surface that it hit, on its side.
TEST(ElementLight, LosesNoLight) {
  const Pool pool;
  const GroupPages rows(pool.groups());
  StatePages pages;
  const PhotonRow row = pool.row(9);
  pages.apply(rows.replace(pages, 3, row));
  glm::dvec3 sent(0);
  for (const ElementHit& hit : row.hits) sent += glm::dvec3(unpackFlux(hit.flux));
  for (const ElementRule rule : {ElementRule::linear, ElementRule::buckets}) {
    auto elements = sceneElements(StillScene(pool.tracer(), nullptr), 0.2f, nullptr);
    const ElementLight light(pool.tracer(), pages, rows,
                             std::make_shared<const SurfaceNumbers>(pool.scene()), elements, rule,
                             nullptr);
    glm::dvec3 found(0);
    for (uint32_t instance = 0; instance < 2; ++instance) {
      const Mesh& mesh = std::as_const(pool.scene()).meshes[instance];
      for (uint32_t k = 0; k < mesh.triangles.size(); ++k)
        for (const bool isBack : {false, true}) {
          constexpr int kPoints = 2000;
          for (int i = 0; i < kPoints; ++i) {
            const Vec2 uv = squareToTriangle(
                Vec2((static_cast<float>(i) + 0.5f) / kPoints,
                     unitFloat(static_cast<uint32_t>(hashWords(k, static_cast<uint64_t>(i))))));
            found += double{areaOf(mesh, k)} / kPoints *
                     glm::dvec3(light.at(pool.tracer(), {instance, k, isBack}, uv.x, uv.y));
          }
        }
    }
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], sent[c], 0.03 * sent[c]);
  }
}

}  // namespace
}  // namespace ninefold
