// The six classes of edits of Ren et al. 2005, Table 1, by an intersection field: what each of them
// makes anew, that it is what a fresh start makes, to the last bit, and that nothing else is
// touched.
//
//   class                      lines of        V, pairs looked at         G, rows traced again
//   1 a lamp's light           -               -                          all
//   2 a material               -               -                          all
//   3 a lamp moves             the lamp        its own; what it hides     all
//   4 a lamp is deformed       the lamp        its own; what it hides     all
//   5 a thing moves            the thing       what it hides or hid       all
//   6 a thing is deformed      the thing       what it hides or hid       all
//
// (Their Table 1, but that class 3 and 5 make lines anew, where theirs takes the nearest ones of the
// old frame.) H is asked at each pixel and is never kept.
#include <gtest/gtest.h>

#include "common/gi/intersection_field/intersection_field.h"
#include "tests/gi/expect.h"
#include "tests/gi/field_room.h"

namespace ninefold {
namespace {

using namespace testing;

Settings smallField(FieldDirect direct, FieldWeights weights = FieldWeights::measure) {
  Settings s = testing::small(Method::intersectionField, 8);
  s.fieldDirect = direct, s.fieldWeights = weights;
  s.camera = fieldRoom().cameras.front();
  return s;
}

struct EditClass {
  std::string name;
  SceneEdit edit;
  std::vector<uint32_t> changed;  // instances whose lines are made anew
};

std::vector<EditClass> classes() {
  const auto dim = [](float by) { return [by](MaterialEdit& m) { m.emission *= by; }; };
  return {
      {"1 a lamp is dimmed", repainted(kFirstLamp, dim(0.4f)), {}},
      {"1 a lamp goes out", repainted(kSecondLamp, dim(0)), {}},
      {"2 a wall is painted",
       repainted(kWalls, [](MaterialEdit& m) { m.baseColor = Vec3(0.6f, 0.6f, 0.3f); }),
       {}},
      {"3 a lamp moves", movedBy(kFirstLamp, DVec3(0.2, -0.4, 0.5)), {kFirstLamp}},
      {"4 a lamp is deformed", bent(kFirstLamp), {kFirstLamp}},
      {"5 a thing moves", movedBy(kBox, DVec3(-0.6, 0.1, -0.6)), {kBox}},
      {"6 a thing is deformed", twistedBox(), {kBox}},
  };
}

struct Made {
  Scene scene;
  Tracer tracer;
  Settings settings;
  Transport transport;
  IntersectionField method;

  // At rest; `before` lends what it knows.
  Made(const SceneEdit& edit, const Settings& s, const Made* before)
      : scene(edited(fieldRoom(), edit)),
        tracer(scene, Isa::automatic),
        settings(s),
        transport(tracer, settings),
        method(transport, nullptr, before == nullptr ? nullptr : &before->method) {}
};

// Pairs of all lamps whose line meets one of the instances, in either scene; of lamps that changed,
// all.
uint64_t linesOf(const Made& before, const Made& after, const std::vector<uint32_t>& changed) {
  const LineField &was = before.method.field(), &is = after.method.field();
  const auto meets = [&](const LineField& field, const GridLine& line) {
    std::vector<LineHit> hits;
    field.hitsOf(line, hits);
    return std::ranges::any_of(hits, [&](const LineHit& hit) {
      return std::ranges::find(changed, hit.instance) != changed.end();
    });
  };
  uint64_t lines = 0;
  for (const AreaLamp& lamp : after.method.lamps()->lamps()) {
    const LocalField& local = is.local(lamp.instance);
    local.forEachRun([&](GridLine line, uint32_t r) {
      const LineRun& run = local.runs()[r];
      for (line.m = run.first; line.m < run.first + run.count; ++line.m)
        if (meets(was, line) || meets(is, line)) ++lines;
    });
  }
  return lines;
}

TEST(FieldEdits, MakeAnewWhatTheirClassTouchesAndNothingElse) {
  const Settings settings = smallField(FieldDirect::field);
  const Made before({}, settings, nullptr);
  for (const EditClass& c : classes()) {
    const Made after(c.edit, settings, &before), fresh(c.edit, settings, nullptr);
    for (uint32_t i = 0; i < after.scene.instances.size(); ++i) {
      const bool isChanged = std::ranges::find(c.changed, i) != c.changed.end();
      EXPECT_EQ(after.method.field().isShared(before.method.field(), i), !isChanged) << c.name;
      EXPECT_EQ(&after.method.nodeLines().of(i) == &before.method.nodeLines().of(i), !isChanged)
          << c.name;
    }
    const uint64_t lines = after.method.lamps()->lines();
    EXPECT_EQ(lines, linesOf(before, after, c.changed)) << c.name;
    EXPECT_EQ(lines == 0, c.changed.empty()) << c.name;
    EXPECT_LT(lines, fresh.method.lamps()->lines()) << c.name;
  }
}

// A uniform lamp that goes out and comes back, and one that shines unevenly.
TEST(FieldEdits, ALampsOwnLightCountsWhereItShinesUnevenly) {
  Scene textured = fieldRoom();
  textured.images.push_back({"spots", 2, 1, 3, false, {255, 255, 255, 20, 20, 20}});
  textured.meshes[1].uv0 = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  textured.materials[1].emissionMap.image = 0;
  Settings settings = smallField(FieldDirect::field);
  const Tracer tracer(textured, Isa::automatic);
  const Transport transport(tracer, settings);
  const IntersectionField before(transport, nullptr);
  Scene brighter = textured;
  brighter.materials[1].emission *= 3;
  const Tracer tracerAfter(brighter, Isa::automatic);
  const Transport after(tracerAfter, settings);
  const IntersectionField kept(after, nullptr, &before), fresh(after, nullptr);
  EXPECT_GT(kept.lamps()->lines(), 0u) << "the uneven one's pairs are made again";
  EXPECT_LT(kept.lamps()->lines(), fresh.lamps()->lines()) << "the even one's are not";
}

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

struct Shown {
  Scene scene;
  Tracer tracer;
  Settings settings;
  Renderer renderer;

  Shown(const SceneEdit& edit, const Settings& s, const Renderer* begun, const Renderer* before)
      : scene(edited(fieldRoom(), edit)),
        tracer(scene, Isa::automatic),
        settings(s),
        renderer(tracer, settings, begun, before) {}
};

uint64_t pictureOf(const Renderer& renderer, const Settings& settings, const StatePages& pages,
                   const MethodState* before) {
  const auto state = renderer.digest(pages, before);
  const auto scratch = renderer.makeScratch();
  const FrameKey key{0, 0, 0, 0.1f};
  TileResult tile;
  uint64_t hash = 0;
  for (int phase = 0; phase < settings.interleave.sets(); ++phase) {
    const auto light = renderer.light(key, phase, state.get());
    renderer.render(Task{key, 0, phase, 0}, *light, *scratch, tile);
    for (const LayerPlanes& layer : tile.layers)
      for (const float e : layer.irradiance.r) hash = hashWords(hash, std::bit_cast<uint32_t>(e));
  }
  return hash;
}

// Traces all rows again, four in each step, as edits call for.
StatePages stepped(const Renderer& renderer, const Settings& settings, StatePages pages) {
  StepKey key;
  key.from = 1, key.to = 2;
  for (uint32_t done = 0; done < fieldRows(settings); done += 4, key.firstUnit += 4) {
    const StatePages from = pages;
    for (uint32_t unit = 0; unit < 4; ++unit)
      pages.apply(renderer.step(from, key, key.firstUnit + unit).deltas);
  }
  return pages;
}

// In a gesture or at rest: once all rows are traced again, state and picture are those of a fresh
// start, to the last bit.
TEST(FieldEdits, EndAsMadeAfresh) {
  const auto holds = [](const EditClass& c, const Settings& settings, bool moving) {
    const Shown before({}, settings, nullptr, nullptr);
    const StatePages old = stateAtRest(before.renderer, settings, 3);
    const auto digested = before.renderer.digest(old);
    const Renderer* begun = moving ? &before.renderer : nullptr;
    const Shown after(c.edit, settings, begun, moving ? nullptr : &before.renderer);
    const Renderer fresh(after.tracer, settings, begun);
    const StatePages pages = stepped(after.renderer, settings, old);
    const StatePages anew = stateAtRest(fresh, settings, 3);
    EXPECT_EQ(rowsOf(pages, settings), rowsOf(anew, settings)) << c.name;
    EXPECT_EQ(pictureOf(after.renderer, settings, pages, digested.get()),
              pictureOf(fresh, settings, anew, nullptr))
        << c.name << (moving ? ", moving" : ", at rest");
    for (const PhotonRow& row : rowsOf(pages, settings))
      EXPECT_NE(row.stamp, rowsOf(old, settings)[0].stamp) << c.name << ": a row of before";
  };
  for (const EditClass& c : classes()) {
    holds(c, smallField(FieldDirect::vpls), false);
    holds(c, smallField(FieldDirect::field), false);
    holds(c, smallField(FieldDirect::field, FieldWeights::alike), false);
    holds(c, smallField(FieldDirect::field), true);
  }
}

// In a gesture the lines stay those of its beginning; at rest they are the scene's. Where the
// bounds are the same, the two are. (A gesture also keeps the lamps' samples as they were.)
TEST(FieldEdits, WhatMovedInAGestureIsAsAtRest) {
  const Settings settings = smallField(FieldDirect::vpls);
  const Shown before({}, settings, nullptr, nullptr);
  for (const EditClass& c : classes()) {
    if (c.name.find("lamp") != std::string::npos) continue;
    const Shown moved(c.edit, settings, &before.renderer, nullptr),
        rested(c.edit, settings, nullptr, nullptr);
    EXPECT_EQ(rowsOf(stateAtRest(moved.renderer, settings, 0), settings),
              rowsOf(stateAtRest(rested.renderer, settings, 0), settings))
        << c.name;
  }
}

// One after another, each with what the one before knew: nothing wears off.
TEST(FieldEdits, ManyInARowEndAsMadeAfresh) {
  const Settings settings = smallField(FieldDirect::field);
  std::vector<std::unique_ptr<Shown>> all;
  all.push_back(std::make_unique<Shown>(SceneEdit(), settings, nullptr, nullptr));
  SceneEdit edit;
  for (int round = 0; round < 2; ++round)
    for (const EditClass& c : classes()) {
      if (round == 0) merge(edit, c.edit);
      if (round == 1 && !c.edit.objects.empty())
        merge(edit, movedBy(c.changed[0], DVec3(0)));  // back again
      all.push_back(std::make_unique<Shown>(edit, settings, nullptr, &all.back()->renderer));
    }
  const Shown& last = *all.back();
  const Renderer fresh(last.tracer, settings);
  const StatePages pages = stateAtRest(last.renderer, settings, 0);
  EXPECT_EQ(rowsOf(pages, settings), rowsOf(stateAtRest(fresh, settings, 0), settings));
  EXPECT_EQ(pictureOf(last.renderer, settings, pages, nullptr),
            pictureOf(fresh, settings, pages, nullptr));
}

// Nothing that a field keeps depends on the view.
TEST(FieldEdits, AnotherViewMakesNothingAnew) {
  Settings settings = smallField(FieldDirect::field);
  const Made before({}, settings, nullptr);
  settings.camera.eye = Vec3(0.4f, 0.2f, 0.9f);
  const Made after({}, settings, &before);
  for (uint32_t i = 0; i < after.scene.instances.size(); ++i)
    EXPECT_TRUE(after.method.field().isShared(before.method.field(), i));
  EXPECT_EQ(after.method.lamps()->lines(), 0u);
}

// A step's units are different rows, those first that show the scene of before.
TEST(FieldEdits, OldRowsAreTracedFirst) {
  const Settings settings = smallField(FieldDirect::vpls);
  const Shown before({}, settings, nullptr, nullptr);
  const Shown after(movedBy(kBox, DVec3(-0.6, 0.1, -0.6)), settings, &before.renderer, nullptr);
  StatePages pages = stateAtRest(before.renderer, settings, 0);
  const StatePages old = pages;
  StepKey key;
  key.from = 1, key.to = 2;
  for (uint32_t unit = 0; unit < 6; ++unit) pages.apply(after.renderer.step(old, key, unit).deltas);
  key.from = 2, key.to = 3, key.firstUnit = 6;
  const StatePages half = pages;
  for (uint32_t unit = 6; unit < 16; ++unit)
    pages.apply(after.renderer.step(half, key, unit).deltas);
  const auto was = rowsOf(old, settings), is = rowsOf(pages, settings);
  for (size_t r = 0; r < is.size(); ++r) EXPECT_NE(is[r].stamp, was[r].stamp) << r;
}

}  // namespace
}  // namespace ninefold
