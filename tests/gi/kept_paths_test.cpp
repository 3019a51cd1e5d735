// Paths that were kept stand for rays. After any edits a client that knows the photons' paths gives
// the same rows, to the last bit, as one that traces them all. It traces less.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "common/gi/renderer.h"
#include "common/gi/whole_state.h"
#include "common/scene/edit.h"
#include "common/scene/methods.h"
#include "tests/gi/expect.h"
#include "tests/gi/make_scene.h"
#include "tests/seeds.h"
#include "tests/tracing/make_scene.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

constexpr int kWall = 0, kLamp = 1, kGlass = 2, kThing = 3, kFence = 4;  // materials
constexpr int kFirstThing = 6;                                           // nodes

// A room with a lamp, a glass ball, a fence with holes, boxes on the floor, two of them in the same
// place, so that rays meet both at the same distance, and a picture in the plane of a wall. A point
// light, too, and a sun that shines in where walls are missing.
Scene room() {
  SceneBuilder b;
  b.material(testing::matte(Vec3(0.6f)));
  b.material(testing::matte(Vec3(0), Vec3(5)));
  b.material(testing::glass(1.5f));
  b.material(testing::matte(Vec3(0.7f, 0.4f, 0.2f)));
  b.material(testing::matte(Vec3(0.5f)));
  const int other = b.material(testing::matte(Vec3(0.2f, 0.6f, 0.3f)));
  const int metal = b.material(testing::mirror(Vec3(0.9f)));
  b.quad(kWall, Vec3(-1, -1, 1), Vec3(2, 0, 0), Vec3(0, 0, -2));
  b.quad(kWall, Vec3(-1, -1, -1), Vec3(2, 0, 0), Vec3(0, 2, 0));
  b.quad(kWall, Vec3(-1, -1, 1), Vec3(0, 0, -2), Vec3(0, 2, 0));
  b.quad(kWall, Vec3(-1, 1, -1), Vec3(2, 0, 0), Vec3(0, 0, 2));
  b.quad(kLamp, Vec3(-0.2f, 0.98f, -0.2f), Vec3(0.4f, 0, 0), Vec3(0, 0, 0.4f));
  b.sphere(kGlass, Vec3(0.4f, -0.6f, 0.3f), 0.2f, 8);
  b.quad(kFence, Vec3(-0.8f, -1, 0.5f), Vec3(0.6f, 0, 0), Vec3(0, 0.8f, 0));
  b.box(kThing, Vec3(-0.6f, -1, -0.6f), Vec3(-0.3f, -0.5f, -0.3f), false);
  b.box(kThing, Vec3(0, -1, 0), Vec3(0.2f, -0.7f, 0.2f), false);
  b.box(other, Vec3(0.5f, -1, -0.7f), Vec3(0.8f, -0.2f, -0.4f), false);
  b.box(metal, Vec3(0.5f, -1, -0.7f), Vec3(0.8f, -0.2f, -0.4f), false);
  b.quad(other, Vec3(-0.5f, -0.2f, -1), Vec3(1, 0, 0), Vec3(0, 0.6f, 0));
  for (int i = 0; i < 40; ++i)  // more things than mask bits
    b.box(i % 2 == 0 ? other : kThing, Vec3(-0.9f + 0.04f * static_cast<float>(i), -1, 0.8f),
          Vec3(-0.88f + 0.04f * static_cast<float>(i), -0.9f, 0.85f), false);
  PunctualLight light;
  light.position = Vec3(-0.5f, 0.3f, 0.5f), light.intensity = Vec3(0.2f);
  b.light(light);
  PunctualLight sun;
  sun.kind = LightKind::directional, sun.direction = glm::normalize(Vec3(-1, -0.7f, -0.2f));
  sun.intensity = Vec3(0.5f);
  b.light(sun);
  b.environment(Vec3(0.1f));
  b.camera(Vec3(0, 0, 0.95f), Vec3(0, -0.3f, -1), 1.2f);
  Scene scene = b.build();
  scene.images.push_back({"holes", 2, 1, 4, false, {255, 255, 255, 0, 255, 255, 255, 255}});
  Material& fence = scene.materials[static_cast<size_t>(kFence)];
  fence.alphaMode = AlphaMode::mask;
  fence.baseColorMap.image = 0, fence.baseColorMap.nearest = true;
  scene.meshes[6].uv0 = {Vec2(0, 0), Vec2(4, 0), Vec2(4, 4), Vec2(0, 4)};
  return scene;
}

Settings pool() {
  Settings s = testing::small(Method::selective, 8);
  s.minorLamps = 0.1f;
  s.photonPool = 4608, s.photonGroups = 72, s.pilotRatio = 16;
  return s;
}

SceneEdit randomEdit(Dice& dice, const Scene& scene) {
  SceneEdit edit;
  switch (dice.below(5)) {
    case 0:
    case 1: {
      const int nodes = static_cast<int>(scene.instances.size()) - kFirstThing;
      ObjectEdit moved{kFirstThing - 1 + dice.below(nodes), DMat4(1)};
      const double turn = double{dice.uniform(-1, 1)}, scale = double{dice.uniform(0.8f, 1.2f)};
      moved.motion[0] = scale * DVec4(std::cos(turn), 0, -std::sin(turn), 0);
      moved.motion[2] = scale * DVec4(std::sin(turn), 0, std::cos(turn), 0);
      moved.motion[3] = DVec4(dice.uniform(-0.1f, 0.1f), 0, dice.uniform(-0.1f, 0.1f), 1);
      edit.objects = {moved};
      break;
    }
    case 2: {
      MaterialEdit material = editOfMaterial(scene, static_cast<uint32_t>(dice.below(7)));
      material.baseColor = Vec3(dice.uniform(0.1f, 0.9f));
      material.transmission = dice.below(3) == 0 ? 1.0f : 0.0f;
      material.roughness = dice.uniform(0, 1), material.metallic = dice.uniform(0, 1);
      edit.materials = {material};
      break;
    }
    case 3: {
      MaterialEdit lamp = editOfMaterial(scene, kLamp);
      lamp.emission = Vec3(dice.uniform(0, 8));
      edit.materials = {lamp};
      break;
    }
    default: {
      LightEdit light = editOf(scene, 0);
      light.position.x = dice.uniform(-0.6f, 0.6f);
      edit.lights = {light};
    }
  }
  return edit;
}

// One state of the scene, and who renders it.
struct Place {
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const Tracer> tracer;
  std::shared_ptr<const Renderer> renderer;
};

Place begin(const Scene& asRead) {
  Place p;
  p.scene = std::make_shared<const Scene>(asRead);
  p.tracer = std::make_shared<const Tracer>(*p.scene, Isa::automatic);
  p.renderer = std::make_shared<const Renderer>(*p.tracer, pool());
  return p;
}

// `remembers`: what came before may save work. `begun`: a gesture's beginning, or null.
Place after(const Place& before, const Scene& asRead, const SceneEdit& all, bool remembers,
            const Place* begun = nullptr) {
  Place p;
  p.scene = std::make_shared<const Scene>(edited(asRead, all, before.scene.get()));
  p.tracer = std::make_shared<const Tracer>(*before.tracer, *p.scene, movedInstances(asRead, all));
  p.renderer = std::make_shared<const Renderer>(*p.tracer, pool(),
                                                begun != nullptr ? begun->renderer.get() : nullptr,
                                                remembers ? before.renderer.get() : nullptr);
  return p;
}

uint32_t rows() { return factsOf(Method::selective).state->unitsOfAll(pool()); }

struct Stepped {
  StatePages pages;
  uint64_t rays = 0;
};
// `units`: all rows, or the first ones in the order of urgency.
Stepped step(const Place& place, const StatePages& from, uint32_t units) {
  StepKey key;
  key.from = 1, key.to = 2, key.units = units;
  Stepped done{from};
  for (uint32_t unit = 0; unit < units; ++unit) {
    const StepResult result = place.renderer->step(from, key, unit);
    done.pages.apply(result.deltas);
    done.rays += result.rays.photon;
  }
  return done;
}

TEST(KeptPaths, StandForRaysWhateverIsEdited) {
  for (const uint64_t seed : seedsFrom(1, 12)) {
    const Repeatable repeatable(seed);
    Dice dice(seed);
    const Scene asRead = room();
    const Place first = begin(asRead);
    Place keeps = first;
    StatePages pages = stateAtRest(*first.renderer, pool(), 3);
    SceneEdit all;
    const Place* begun = dice.below(2) == 0 ? &first : nullptr;
    for (int edit = 0; edit < 8; ++edit) {
      merge(all, randomEdit(dice, *keeps.scene));
      keeps = after(keeps, asRead, all, true, begun);
      const Place forgets = after(first, asRead, all, false, begun);
      const uint32_t units = dice.below(2) == 0 ? rows() : rows() / 3;
      const Stepped known = step(keeps, pages, units), traced = step(forgets, pages, units);
      ASSERT_EQ(known.pages.hash(), traced.pages.hash()) << "after edit " << edit;
      EXPECT_LE(known.rays, traced.rays);
      pages = known.pages;
    }
  }
}

TEST(KeptPaths, SaveMostRaysWhenALittleThingMoves) {
  const Scene asRead = room();
  const Place first = begin(asRead);
  const StatePages pages = stateAtRest(*first.renderer, pool(), 3);
  SceneEdit moved;
  ObjectEdit box{8, DMat4(1)};
  box.motion[3].x = 0.1;
  moved.objects = {box};
  const Stepped known = step(after(first, asRead, moved, true), pages, rows());
  const Stepped traced = step(after(first, asRead, moved, false), pages, rows());
  EXPECT_LT(static_cast<double>(known.rays), 0.3 * static_cast<double>(traced.rays));
  EXPECT_EQ(known.pages.hash(), traced.pages.hash());
}

// A sheet of water under which a lamp lies is the only solid, until it is none.
TEST(KeptPaths, KnowWhatALampLayIn) {
  SceneBuilder b;
  const int wall = b.material(testing::matte(Vec3(0.6f)));
  Material water = testing::glass(1.33f);
  water.attenuationDistance = 0.5f, water.attenuationColor = Vec3(0.3f, 0.6f, 0.9f);
  const int sheet = b.material(water);
  b.box(wall, Vec3(-1), Vec3(1), true);
  b.quad(sheet, Vec3(-1, 0, 1), Vec3(2, 0, 0), Vec3(0, 0, -2));
  PunctualLight light;
  light.position = Vec3(0, -0.5f, 0), light.intensity = Vec3(1);
  b.light(light);
  const Scene asRead = b.build();
  const Place first = begin(asRead);
  const StatePages pages = stateAtRest(*first.renderer, pool(), 3);
  SceneEdit dry;
  dry.materials = {editOfMaterial(asRead, static_cast<uint32_t>(sheet))};
  dry.materials[0].transmission = 0;
  const Stepped known = step(after(first, asRead, dry, true), pages, rows());
  const Stepped traced = step(after(first, asRead, dry, false), pages, rows());
  EXPECT_EQ(known.pages.hash(), traced.pages.hash());
}

TEST(KeptPaths, OfAnUndoneEditNeedNoRay) {
  const Scene asRead = room();
  const Place first = begin(asRead);
  const StatePages pages = stateAtRest(*first.renderer, pool(), 3);
  SceneEdit bright;
  bright.materials = {editOfMaterial(asRead, kThing)};
  bright.materials[0].baseColor = Vec3(0.1f);
  const Place changed = after(first, asRead, bright, true);
  const Place back = after(changed, asRead, {}, true);
  EXPECT_EQ(step(back, pages, rows()).rays, 0u) << "nothing was traced meanwhile";
  EXPECT_GT(step(changed, pages, rows()).rays, 0u);
}

}  // namespace
}  // namespace ninefold
