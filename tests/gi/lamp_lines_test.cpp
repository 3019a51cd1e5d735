// The pairs of a page, made all at once, are those that its lines give one by one.
#include "common/gi/intersection_field/lamp_lines.h"

#include <gtest/gtest.h>

#include "tests/gi/field_room.h"
#include "tests/gi/render.h"

namespace ninefold {
namespace {

struct Made {
  Scene scene;
  Tracer tracer;
  Settings settings;
  Transport transport;
  SceneElements elements;
  LineField field;
  LampScene lamps;

  explicit Made(const Scene& its)
      : scene(its),
        tracer(scene, Isa::automatic),
        settings(settingsOf()),
        transport(tracer, settings),
        elements(StillScene(tracer, nullptr), settings.elementSize * transport.radius, nullptr),
        field(LineGrid(scene.bounds, 9, 16), scene, nullptr),
        lamps(transport, field, elements) {}

  static Settings settingsOf() {
    Settings s = testing::small(Method::intersectionField, 8);
    s.fieldDirect = FieldDirect::field;
    return s;
  }
};

// A lamp that is closed, one that is bright in places and one that shines both ways; things that
// lie close to each other, and in one place.
Scene roomOf() {
  testing::SceneBuilder b;
  const int grey = b.material(testing::matte(Vec3(0.6f)));
  b.box(grey, Vec3(-1), Vec3(1), true);
  b.box(grey, Vec3(0.1f, -1, 0.2f), Vec3(0.55f, -0.3f, 0.65f), false);
  b.quad(grey, Vec3(-0.9f, -0.995f, -0.5f), Vec3(0, 0, 0.6f), Vec3(0.6f, 0, 0));
  b.box(b.material(testing::matte(Vec3(0), Vec3(2))), Vec3(-0.5f, 0.2f, -0.4f),
        Vec3(-0.3f, 0.4f, -0.2f), false);
  b.quad(b.material(testing::matte(Vec3(0), Vec3(5))), Vec3(-0.2f, 0.9f, -0.1f), Vec3(0.4f, 0, 0),
         Vec3(0, 0, 0.4f));
  Material shade = testing::matte(Vec3(0.2f), Vec3(1));
  shade.doubleSided = true;
  b.quad(b.material(shade), Vec3(0.2f, 0.1f, -0.6f), Vec3(0.5f, 0, 0), Vec3(0, 0.3f, 0.2f));
  b.camera(Vec3(0, 0, 0.95f), Vec3(0, -0.3f, -1), 1.2f);
  Scene scene = b.build();
  scene.images.push_back({"spots", 2, 1, 3, false, {255, 255, 255, 20, 20, 20}});
  const auto spotted = static_cast<size_t>(scene.instances[4].mesh);
  scene.meshes[spotted].uv0 = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  scene.materials[static_cast<size_t>(scene.meshes[spotted].material)].emissionMap.image = 0;
  return scene;
}

struct Pair {
  uint32_t instance, triangle;
  bool isBack, isSeen;
  float weight;
  Vec2 at;
};

// As lamp_pairs.h says it, from a line's hits.
std::vector<Pair> pairsOfLine(const Made& made, const AreaLamp& lamp, const GridLine& line,
                              const LineRun& run) {
  std::vector<Pair> pairs;
  std::vector<LineHit> hits;
  made.field.hitsOf(line, hits);
  const LineGrid& grid = made.field.grid();
  const LineHit q{lamp.instance, run.triangle, run.at(line.m)};
  const auto emitter = static_cast<uint32_t>(made.transport.emitters.find(q.instance, q.triangle));
  float weight = made.lamps.wayOf(line).weight;
  if (!lamp.isEven)
    weight *= maxComponent(
                  made.transport.emitters.pointAt(emitter, made.field.placeOf(line, q)).radiance) /
              lamp.brightest;
  const Vec3 forward = grid.directionOf(line);
  const float length = grid.lengthOf(line), least = grid.rounding() / length;
  const float close = 0.125f * made.settings.elementSize * made.transport.radius / length;
  const auto normalAt = [&](const LineHit& hit) {
    return made.tracer.frontNormal(hit.instance, hit.triangle);
  };
  for (const float sign : {-1.0f, 1.0f}) {
    if (!lamp.doubleSided && !(sign * glm::dot(normalAt(q), forward) > 0)) continue;
    std::vector<LineHit> beyond;
    for (const LineHit& hit : hits)
      if (sign * (hit.t - q.t) >= least) beyond.push_back(hit);
    std::ranges::stable_sort(beyond, {}, [&](const LineHit& hit) { return sign * hit.t; });
    for (size_t k = 0; k < beyond.size(); ++k) {
      const LineHit& hit = beyond[k];
      if (k > 0 && std::abs(hit.t - beyond[k - 1].t) < close) continue;  // it is covered
      pairs.push_back({hit.instance, hit.triangle, sign * glm::dot(normalAt(hit), forward) > 0,
                       k == 0, weight, made.field.placeOf(line, hit)});
    }
  }
  return pairs;
}

TEST(LampLines, GiveThePairsOfEachLine) {
  const Made made(roomOf());
  LampLines lines(made.lamps);
  const std::vector<AreaLamp> lamps = areaLamps(made.transport);
  ASSERT_EQ(lamps.size(), 3u);
  size_t pairs = 0;
  for (const AreaLamp& lamp : lamps) {
    const LocalField& local = made.field.local(lamp.instance);
    local.forEachPage([&](GridLine line, uint32_t first, uint32_t end) {
      std::vector<Pair> wanted;
      for (uint32_t r = first; r < end; ++r)
        for (line.m = local.runs()[r].first; line.m < local.runs()[r].first + local.runs()[r].count;
             ++line.m)
          for (const Pair& pair : pairsOfLine(made, lamp, line, local.runs()[r]))
            wanted.push_back(pair);
      const std::vector<LampLines::Pair>& found = lines.pairsOf(lamp, line, nullptr);
      ASSERT_EQ(found.size(), wanted.size());
      for (size_t k = 0; k < found.size(); ++k, ++pairs) {
        const Pair& pair = wanted[k];
        ASSERT_EQ(found[k].instance, pair.instance);
        ASSERT_EQ(found[k].elements.points,
                  made.elements.block(pair.instance).elementsOf(pair.triangle).points);
        ASSERT_EQ(found[k].isBack, pair.isBack);
        ASSERT_EQ(found[k].seen, Vec3(pair.isSeen ? 1.0f : 0.0f));
        ASSERT_NEAR(found[k].weight, pair.weight, 0.01f * pair.weight);
        ASSERT_LT(glm::length(found[k].at - pair.at), 1e-3f);
      }
    });
  }
  EXPECT_GT(pairs, 4000u);
}

// Some of a page's lines: as many pairs less.
TEST(LampLines, GiveThoseOfSomeLinesAlone) {
  const Made made(testing::fieldRoom());
  LampLines lines(made.lamps);
  const AreaLamp lamp = areaLamps(made.transport).front();
  LampLines::Lines even, odd;
  for (size_t m = 0; m < even.size(); ++m) (m % 2 == 0 ? even : odd).set(m);
  size_t all = 0, parts = 0;
  made.field.local(lamp.instance).forEachPage([&](const GridLine& page, uint32_t, uint32_t) {
    all += lines.pairsOf(lamp, page, nullptr).size();
    parts += lines.pairsOf(lamp, page, &even).size();
    parts += lines.pairsOf(lamp, page, &odd).size();
  });
  EXPECT_GT(all, 500u);
  EXPECT_EQ(parts, all);
}

}  // namespace
}  // namespace ninefold
