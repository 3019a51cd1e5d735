// The method intersection field: what its steps do after each kind of edit, and that light which
// goes along lines ends up where light goes.
#include "common/gi/intersection_field/intersection_field.h"

#include <gtest/gtest.h>

#include "tests/gi/expect.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

// A room with two lamps under its ceiling and a box that stands on the floor.
struct Room {
  Vec3 box{0.1f, -1, 0.2f}, lamp{-0.6f, 0.9f, -0.2f};
  float firstLamp = 5, secondLamp = 5;
  Vec3 wall{0.6f};
  Vec3 eye{0, 0, 0.95f};

  Scene build() const {
    SceneBuilder b;
    b.box(b.material(testing::matte(wall)), Vec3(-1), Vec3(1), true);
    b.quad(b.material(testing::matte(Vec3(0), Vec3(firstLamp))), Vec3(0), Vec3(0.3f, 0, 0),
           Vec3(0, 0, 0.3f));
    b.quad(b.material(testing::matte(Vec3(0), Vec3(secondLamp))), Vec3(0.4f, 0.9f, -0.1f),
           Vec3(0.3f, 0, 0), Vec3(0, 0, 0.3f));
    b.box(b.material(testing::matte(Vec3(0.7f, 0.3f, 0.2f))), Vec3(0), Vec3(0.45f, 0.7f, 0.45f),
          false);
    b.camera(eye, Vec3(0, -0.3f, -1), 1.2f);
    Scene scene = b.build();
    scene.instances[1].toWorld[3] = DVec4(DVec3(lamp), 1);
    scene.instances[3].toWorld[3] = DVec4(DVec3(box), 1);
    scene.bounds = {};
    for (const Vec3& corner : {Vec3(-1), Vec3(1)}) scene.bounds.add(corner);
    return scene;
  }
};

Settings smallField(FieldDirect direct = FieldDirect::vpls) {
  Settings s = testing::small(Method::intersectionField, 8);
  s.fieldDirect = direct;
  return s;
}

// The classes of edits of Ren et al. 2005, Table 1, but for deformation, for which there is no
// edit.
std::vector<std::pair<std::string, Room>> edits() {
  std::vector<std::pair<std::string, Room>> all;
  const auto add = [&](const char* name, auto&& change) {
    Room room;
    change(room);
    all.emplace_back(name, room);
  };
  add("a lamp is dimmed", [](Room& r) { r.firstLamp = 2; });
  add("a lamp goes out", [](Room& r) { r.secondLamp = 0; });
  add("a wall is painted", [](Room& r) { r.wall = Vec3(0.6f, 0.6f, 0.3f); });
  add("a lamp moves", [](Room& r) { r.lamp = Vec3(-0.4f, 0.5f, 0.3f); });
  add("a thing moves", [](Room& r) { r.box = Vec3(-0.5f, -0.9f, -0.4f); });
  add("the camera moves", [](Room& r) { r.eye = Vec3(0.4f, 0.2f, 0.9f); });
  return all;
}

struct Shown {
  Scene scene;
  Tracer tracer;
  Settings settings;
  Renderer renderer;

  Shown(const Room& room, Settings s, const Renderer* begun)
      : scene(room.build()),
        tracer(scene, Isa::automatic),
        settings([&] {
          s.camera = scene.cameras.front();
          return s;
        }()),
        renderer(tracer, settings, begun) {}
};

// The rows of all pages, whatever version they were made for.
std::vector<PhotonRow> rowsOf(const StatePages& pages, const Settings& settings) {
  const PhotonRows rows(fieldRows(settings), kPhotonsOfRow);
  std::vector<PhotonRow> all;
  for (uint32_t r = 0; r < rows.count(); ++r) {
    all.push_back(*rows.read(pages, r));
    all.back().version = 0;
  }
  return all;
}

uint64_t pictureOf(const Shown& shown, const StatePages& pages, const MethodState* before) {
  const auto state = shown.renderer.digest(pages, before);
  const auto scratch = shown.renderer.makeScratch();
  const FrameKey key{0, 0, 0, 0.1f};
  TileResult tile;
  uint64_t hash = 0;
  for (int phase = 0; phase < shown.settings.interleave.sets(); ++phase) {
    const auto light = shown.renderer.light(key, phase, state.get());
    shown.renderer.render(Task{key, 0, phase, 0}, *light, *scratch, tile);
    for (const LayerPlanes& layer : tile.layers)
      for (const float e : layer.irradiance.r) hash = hashWords(hash, std::bit_cast<uint32_t>(e));
  }
  return hash;
}

// Whatever was edited: once all rows are traced again, state and picture are those of a fresh
// start, to the last bit. What belongs to things that stayed was used again.
TEST(IntersectionField, AfterAnEditIsAsMadeAfresh) {
  for (const FieldDirect direct : {FieldDirect::vpls, FieldDirect::field})
    for (const auto& [name, room] : edits()) {
      const Settings settings = smallField(direct);
      const Shown before(Room(), settings, nullptr);
      StatePages pages = stateAtRest(before.renderer, before.settings, 3);
      const auto digested = before.renderer.digest(pages);
      const Shown after(room, settings, &before.renderer);
      StepKey key;
      key.from = 1, key.to = 2;
      for (uint32_t done = 0; done < fieldRows(settings); done += 4, key.firstUnit += 4) {
        const StatePages from = pages;
        for (uint32_t unit = 0; unit < 4; ++unit)
          pages.apply(after.renderer.step(from, key, key.firstUnit + unit).deltas);
      }
      const StatePages fresh = stateAtRest(after.renderer, after.settings, 3);
      EXPECT_EQ(rowsOf(pages, settings), rowsOf(fresh, settings)) << name;
      EXPECT_EQ(pictureOf(after, pages, digested.get()), pictureOf(after, fresh, nullptr)) << name;
    }
}

// In a gesture the lines stay those of its beginning; at rest they are the scene's. Where the
// bounds are the same, the two are.
TEST(IntersectionField, WhatMovedInAGestureIsAsAtRest) {
  for (const auto& [name, room] : edits()) {
    if (room.firstLamp != Room().firstLamp || room.secondLamp != Room().secondLamp) continue;
    if (room.lamp != Room().lamp) continue;  // a gesture keeps the lamps' samples as they were
    const Shown before(Room(), smallField(), nullptr);
    const Shown moved(room, smallField(), &before.renderer), afresh(room, smallField(), nullptr);
    EXPECT_EQ(rowsOf(stateAtRest(moved.renderer, moved.settings, 0), moved.settings),
              rowsOf(stateAtRest(afresh.renderer, afresh.settings, 0), afresh.settings))
        << name;
  }
}

// A step's units are different rows, those first that show the scene of before.
TEST(IntersectionField, OldRowsAreTracedFirst) {
  const Shown before(Room(), smallField(), nullptr);
  const Room room = edits()[4].second;
  const Shown after(room, smallField(), &before.renderer);
  StatePages pages = stateAtRest(before.renderer, before.settings, 0);
  const StatePages old = pages;
  StepKey key;
  key.from = 1, key.to = 2;
  for (uint32_t unit = 0; unit < 6; ++unit) pages.apply(after.renderer.step(old, key, unit).deltas);
  key.from = 2, key.to = 3, key.firstUnit = 6;
  const StatePages half = pages;
  for (uint32_t unit = 6; unit < 16; ++unit)
    pages.apply(after.renderer.step(half, key, unit).deltas);
  const auto was = rowsOf(old, before.settings), is = rowsOf(pages, before.settings);
  for (size_t r = 0; r < is.size(); ++r) EXPECT_NE(is[r].stamp, was[r].stamp) << r;
}

// Bounced light in the room, at lines of two resolutions, against the reference: the mean, and
// pixel by pixel.
TEST(IntersectionField, TendsToTheTruthWithMoreLines) {
  const Scene scene = Room().build();
  const Tracer tracer(scene, Isa::automatic);
  Settings truth = testing::small(Method::instantRadiosity, 16);
  truth.directVpls = 16, truth.indirectVpls = 64;
  const auto wanted = testing::render(tracer, truth, 192);
  const auto errorOf = [&](int directions, int distances) {
    Settings s = smallField();
    s.width = s.height = 16, s.directVpls = 16, s.fieldPhotons = 65536;
    s.fieldDirections = directions, s.fieldDistances = distances;
    const auto found = testing::render(tracer, s, 8);
    EXPECT_NEAR(found.grey(), wanted.grey(), (directions > 9 ? 0.03 : 0.08) * wanted.grey());
    double sum = 0;
    for (size_t i = 0; i < found.pixels.size(); ++i)
      sum += std::pow(double{found.pixels[i].x - wanted.pixels[i].x}, 2);
    return std::sqrt(sum / static_cast<double>(found.pixels.size())) / wanted.grey();
  };
  const double coarse = errorOf(5, 8), fine = errorOf(25, 48);
  EXPECT_LT(fine, 0.8 * coarse);
  EXPECT_LT(fine, 0.06);
}

// Things far smaller than the lines lie apart are lit and send light on all the same.
TEST(IntersectionField, SmallThingsSendLightByRays) {
  SceneBuilder b;
  b.box(b.material(testing::matte(Vec3(0.6f), Vec3(1))), Vec3(-1), Vec3(1), true);
  const int white = b.material(testing::matte(Vec3(0.8f)));
  for (int k = 0; k < 20; ++k) {
    const auto at = static_cast<float>(k) * 0.05f - 0.5f;
    b.box(white, Vec3(at, -0.4f, 0), Vec3(at + 0.01f, -0.39f, 0.01f), false);
  }
  const Scene scene = b.build();
  const Tracer tracer(scene, Isa::automatic);
  Settings s = smallField();
  s.fieldDirections = 9, s.fieldDistances = 14, s.camera = scene.cameras.front();
  const auto found = testing::render(tracer, s, 4);
  for (const Vec3& p : found.pixels) ASSERT_TRUE(isFinite(p));
  EXPECT_NEAR(found.grey(), 2.5, 0.1);
}

}  // namespace
}  // namespace ninefold
