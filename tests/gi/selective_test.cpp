// Selective photon tracing: what steps do after an edit, in which order, and where light ends up.
#include "common/gi/selective/selective.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

#include "common/gi/elements/packed_flux.h"
#include "common/gi/selective/group_shooting.h"
#include "tests/gi/expect.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

// A room with two lamps in the ceiling, a box that stands on the floor, and a point light.
struct Room {
  Vec3 box{0.3f, -1, 0.2f};
  float firstLamp = 5, secondLamp = 5, point = 0.2f;
  Vec3 wall{0.6f};

  Scene build() const {
    SceneBuilder b;
    b.box(b.material(testing::matte(wall)), Vec3(-1), Vec3(1), true);
    const int red = b.material(testing::matte(Vec3(0.7f, 0.2f, 0.2f)));
    b.quad(b.material(testing::matte(Vec3(0), Vec3(firstLamp))), Vec3(-0.7f, 0.99f, -0.1f),
           Vec3(0.2f, 0, 0), Vec3(0, 0, 0.2f));
    b.quad(b.material(testing::matte(Vec3(0), Vec3(secondLamp))), Vec3(0.5f, 0.99f, -0.1f),
           Vec3(0.2f, 0, 0), Vec3(0, 0, 0.2f));
    b.box(red, Vec3(0), Vec3(0.25f, 0.4f, 0.25f), false);
    PunctualLight light;
    light.position = Vec3(-0.5f, -0.5f, 0.5f), light.intensity = Vec3(point);
    b.light(light);
    b.camera(Vec3(0, 0, 0.95f), Vec3(0, -0.3f, -1), 1.2f);
    Scene scene = b.build();
    scene.instances[3].toWorld[3] = DVec4(DVec3(box), 1);
    scene.bounds = {};
    for (const Vec3& corner : {Vec3(-1), Vec3(1)}) scene.bounds.add(corner);
    return scene;
  }
};

Settings poolOf(int photons = 18432, int groups = 288) {
  Settings s = testing::small(Method::selective, 8);
  s.photonPool = photons, s.photonGroups = groups, s.pilotRatio = 16;
  return s;
}

// A state that is made, and made again after edits.
class Session {
 public:
  explicit Session(const Room& room, Settings settings = poolOf()) : settings_(settings) {
    show(room, nullptr);
    pages_ = stateAtRest(*renderer_, settings_, 3);
  }
  // A gesture goes on from what the session began with.
  void edit(const Room& room) {
    if (!begun_) begun_ = renderer_;
    show(room, begun_.get());
  }
  void step(uint32_t units) {
    StepKey key;
    key.from = 1, key.firstUnit = nextUnit_;
    const StatePages before = pages_;
    for (uint32_t unit = 0; unit < units; ++unit)
      pages_.apply(renderer_->step(before, key, key.firstUnit + unit).deltas);
    nextUnit_ += units;
  }
  // The rows of a fresh start in the present scene, with the numbers of this one.
  StatePages fresh() const { return stateAtRest(*renderer_, settings_, 3); }
  const StatePages& pages() const { return pages_; }
  std::shared_ptr<const MethodState> digest() const { return renderer_->digest(pages_); }

  // Groups whose rows are not those of `other`.
  std::set<uint32_t> differing(const StatePages& other) const {
    const PhotonGroups groups(settings_);
    const GroupPages rows(groups);
    std::set<uint32_t> found;
    for (uint32_t g = 0; g < groups.rows(); ++g)
      if (!isSame(*rows.read(pages_, g), *rows.read(other, g))) found.insert(g);
    return found;
  }
  // Hits that are not where `other` has them, of all groups.
  size_t hitsAmiss(const StatePages& other) const {
    const PhotonGroups groups(settings_);
    const GroupPages rows(groups);
    size_t count = 0;
    for (uint32_t g = 0; g < groups.rows(); ++g) {
      const auto hash = [](const ElementHit& h) {
        return hashWords(h.surface, uint64_t{h.u} << 16 | h.v, h.flux);
      };
      std::multiset<uint64_t> wanted;
      const PhotonRow there = *rows.read(other, g), here = *rows.read(pages_, g);
      for (const ElementHit& hit : there.hits) wanted.insert(hash(hit));
      for (const ElementHit& hit : here.hits) {
        const auto found = wanted.find(hash(hit));
        if (found != wanted.end()) wanted.erase(found);
      }
      count += wanted.size();
    }
    return count;
  }

 private:
  // Whatever version they were made for.
  static bool isSame(PhotonRow a, const PhotonRow& b) {
    a.version = b.version;
    return a == b;
  }
  void show(const Room& room, const Renderer* begun) {
    scenes_.push_back(std::make_unique<Scene>(room.build()));
    tracers_.push_back(std::make_unique<Tracer>(*scenes_.back(), Isa::automatic));
    settings_.camera = scenes_.back()->cameras.front();
    renderer_ = std::make_shared<const Renderer>(*tracers_.back(), settings_, begun);
  }

  Settings settings_;
  std::vector<std::unique_ptr<Scene>> scenes_;
  std::vector<std::unique_ptr<Tracer>> tracers_;
  std::shared_ptr<const Renderer> renderer_, begun_;
  StatePages pages_;
  uint32_t nextUnit_ = 0;
};

std::vector<std::pair<std::string, Room>> edits() {
  std::vector<std::pair<std::string, Room>> all;
  const auto add = [&](const char* name, auto&& change) {
    Room room;
    change(room);
    all.emplace_back(name, room);
  };
  add("the box moves", [](Room& r) { r.box = Vec3(-0.4f, -0.9f, -0.3f); });
  add("a lamp is dimmed", [](Room& r) { r.firstLamp = 2; });
  add("a lamp goes out", [](Room& r) { r.secondLamp = 0; });
  add("the point light doubles", [](Room& r) { r.point = 0.4f; });
  add("the wall is painted", [](Room& r) { r.wall = Vec3(0.6f, 0.6f, 0.3f); });
  return all;
}

// Bit for bit, whatever was edited, while steps of any size run.
TEST(Selective, AllGroupsTracedAnewAreAFreshStart) {
  for (const auto& [name, room] : edits()) {
    Session session{Room()};
    session.edit(room);
    EXPECT_FALSE(session.differing(session.fresh()).empty()) << name;
    for (uint32_t done = 0, units = 1; done < 306; done += units, units = std::min(units * 2, 31u))
      session.step(std::min(units, 306 - done));
    EXPECT_TRUE(session.differing(session.fresh()).empty()) << name;
  }
}

// A third lamp that is switched on: its photons come from all of it, and go everywhere. Of each
// quarter of a photon's first number there are as many bounces, as lamps are alike.
TEST(Selective, ALampOfASecondStreamIsSampledAllOver) {
  Room dark;
  dark.point = 0, dark.secondLamp = 0;
  Room lit = dark;
  lit.secondLamp = 5;  // as strong as the first
  Session session(dark, poolOf(73728));
  session.edit(lit);
  for (int i = 0; i < 10; ++i) session.step(31);
  const auto fluxAlong = [](const StatePages& pages) {
    const PhotonGroups groups(poolOf(73728));
    const GroupPages rows(groups);
    std::map<uint32_t, double> flux;  // by surface
    for (uint32_t r = 0; r < groups.rows(); ++r) {
      const PhotonRow row = *rows.read(pages, r);
      for (const ElementHit& hit : row.hits)
        flux[hit.surface] += static_cast<double>(unpackFlux(hit.flux).x);
    }
    return flux;
  };
  const auto found = fluxAlong(session.pages());
  for (const auto& [surface, wanted] : fluxAlong(Session(lit, poolOf(73728)).pages())) {
    if (wanted < 0.05) continue;
    EXPECT_NEAR(found.at(surface), wanted, 0.05 * wanted) << surface;
  }
}

// A client that was there from the start and one that came late, which has only the scene after the
// edit and the pages, make the same units, in whatever order.
TEST(Selective, AnyClientMakesTheSameUnits) {
  const Scene before = Room().build();
  Room moved;
  moved.box.x = -0.2f;
  const Scene after = moved.build();
  const Tracer first(before, Isa::automatic);
  const Tracer old(first, after, {false, false, false, true}), late(after, Isa::automatic);
  Settings s = poolOf();
  s.camera = before.cameras.front();
  const Renderer begun(first, s), there(old, s, &begun), came(late, s, &begun);
  StatePages pages = stateAtRest(begun, s, 3);
  StatePages copy = pages;
  StepKey key;
  key.from = 1, key.to = 2;
  for (const uint32_t units : {7u, 30u, 1u}) {
    const StatePages from = pages;
    for (uint32_t unit = 0; unit < units; ++unit)
      pages.apply(there.step(from, key, key.firstUnit + unit).deltas);
    for (uint32_t unit = units; unit-- > 0;)
      copy.apply((unit % 2 == 0 ? came : there).step(from, key, key.firstUnit + unit).deltas);
    EXPECT_EQ(pages.hash(), copy.hash());
    key.firstUnit += units, key.from = key.to, ++key.to;
  }
}

// A view of the left half and one of the right half: each has the groups first whose pilots hit
// what it shows.
TEST(Selective, GroupsThatTheViewShowsGoFirst) {
  const Scene scene = Room().build();
  const Tracer tracer(scene, Isa::automatic);
  const Settings s = poolOf(73728);
  const Renderer renderer(tracer, s);
  StatePages pages = stateAtRest(renderer, s, 3);
  const PhotonGroups groups(s);
  // All groups are alike urgent.
  PageDeltas deltas;
  GroupPages::addPriorities(std::vector<int64_t>(groups.groups(), int64_t{1} << 32), deltas);
  pages.apply(deltas);
  const SurfaceNumbers surfaces(scene);
  const GroupOrder order(tracer, groups, surfaces, 12345);  // a stamp that no row has
  const auto firstFifty = [&](float towards) {
    Camera camera;
    camera.eye = Vec3(0, 0, 0.9f), camera.forward = glm::normalize(Vec3(towards, 0, -0.3f));
    camera.verticalFov = 0.9f;
    std::set<uint32_t> first;
    for (uint32_t rank = 0; first.size() < 50; ++rank) {
      const uint32_t row = order.rowOf(pages, {camera, 64, 64, {}}, StepKey{}, rank);
      if (!groups.hasPilots(row)) first.insert(row);
    }
    return first;
  };
  const auto left = firstFifty(-1), right = firstFifty(1);
  std::vector<uint32_t> both;
  std::ranges::set_intersection(left, right, std::back_inserter(both));
  EXPECT_LT(both.size(), 30u);
  EXPECT_EQ(firstFifty(-1), left);
}

// What has no room is thinned: the flux stays, and each pilot keeps hits of its own.
TEST(Selective, ARowThatIsTooLongIsThinned) {
  const Scene scene = Room().build();
  const Tracer tracer(scene, Isa::automatic);
  const Settings s = poolOf(18432, 2);
  const Transport transport(tracer, s);
  const PhotonGroups groups(s);
  const SurfaceNumbers surfaces(scene);
  const VisualMasking masking(scene, 0.1f);
  const MinorLamps minor;
  const auto world = std::make_shared<const PathWorld>(transport, minor);
  const uint32_t pilots = groups.groups();
  RayCounts rays;
  const auto shot = [&](size_t room) {
    const GroupShooting shooting{transport,          groups, surfaces, masking, minor, 1,
                                 transport.lampFlux, room,   world,    nullptr};
    return shooting.shoot(pilots, 3, 1, rays);
  };
  const auto flux = [](const PhotonRow& row) {
    double sum = 0;
    for (const ElementHit& hit : row.hits) sum += static_cast<double>(unpackFlux(hit.flux).x);
    return sum;
  };
  const PhotonRow all = shot(1 << 20), some = shot(all.hits.size() / 3);
  EXPECT_EQ(some.hits.size(), all.hits.size() / 3);
  EXPECT_NEAR(flux(some), flux(all), 0.05 * flux(all));
  EXPECT_EQ(some.pilots.back().end, some.hits.size());
  for (size_t k = 1; k < some.pilots.size(); ++k) {
    EXPECT_GE(some.pilots[k].end, some.pilots[k - 1].end);
    EXPECT_NEAR(some.pilots[k].end, all.pilots[k].end / 3.0, 1.5);
  }
}

// A surface of which half the texels have no D: the other half is as bright as if all had.
TEST(Selective, TexelsWithoutDiffuseLightAreAreaAllTheSame) {
  const auto brightness = [](float metallicThere) {
    SceneBuilder b;
    b.box(b.material(testing::matte(Vec3(0.5f))), Vec3(-1), Vec3(1), true);
    Material tiles = testing::matte(Vec3(0.5f));
    tiles.metallic = 1, tiles.roughness = 0.3f;
    b.quad(b.material(tiles), Vec3(-1, -0.99f, 1), Vec3(2, 0, 0), Vec3(0, 0, -2));
    PunctualLight light;
    light.position = Vec3(0, 0.5f, 0), light.intensity = Vec3(1);
    b.light(light);
    // Onto the left half, which is matte; the right one is metal or not.
    b.camera(Vec3(-0.5f, 0.5f, 0), Vec3(-0.5f, -1, 0.001f), 0.3f);
    Scene scene = b.build();
    TextureImage image{"tiles", 2, 1, 3, false, {0, 255, 0, 0, 255, 0}};
    image.texels[5] = static_cast<uint8_t>(255 * metallicThere);
    scene.images.push_back(image);
    TextureUse use;
    use.image = 0, use.nearest = true;
    scene.materials[1].metallicRoughnessMap = use;
    scene.meshes[1].uv0 = {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
    validate(scene);
    const Tracer tracer(scene, Isa::automatic);
    Settings s = poolOf(73728);
    s.elementSize = 2, s.directVpls = 0, s.caustics = Caustics::off, s.photons = 0;
    s.pathLength = 2;  // one bounce: the same light falls onto both
    return testing::render(tracer, s, 2).grey();
  };
  EXPECT_NEAR(brightness(1), brightness(0), 0.05 * brightness(0));
}

// Two edits, the second while groups of the first are still to be traced.
TEST(Selective, AnEditInMidUpdateStartsOver) {
  Session session{Room()};
  Room room;
  room.box.x = -0.2f;
  session.edit(room);
  session.step(100);
  room.firstLamp = 1;
  session.edit(room);
  for (int i = 0; i < 10; ++i) session.step(32);
  EXPECT_TRUE(session.differing(session.fresh()).empty());
}

// A lamp that was off when the gesture began has photons of its own, and all of its flux.
TEST(Selective, ALampThatIsSwitchedOnInAGestureShines) {
  Room dark;
  dark.secondLamp = 0;
  Session session(dark);
  session.edit(Room());
  session.step(306);
  const auto bounced = [](const StatePages& pages) {
    const PhotonGroups groups(poolOf());
    const GroupPages rows(groups);
    double sum = 0;
    for (uint32_t g = 0; g < groups.rows(); ++g) {
      const PhotonRow row = *rows.read(pages, g);
      for (const ElementHit& hit : row.hits) sum += static_cast<double>(unpackFlux(hit.flux).y);
    }
    return sum;
  };
  const double lit = bounced(Session{Room()}.pages());
  EXPECT_NEAR(bounced(session.pages()), lit, 0.02 * lit);
  EXPECT_LT(bounced(Session(dark).pages()), 0.9 * lit);
}

// Of all hits that an edit displaces, the first quarter of the groups brings well over a quarter.
TEST(Selective, WhatAnEditConcernsIsTracedFirst) {
  struct Case {
    Room room;
    double least;
  };
  Room small, dimmed;
  small.box = Vec3(0.3f, -1, -0.3f), dimmed.firstLamp = 2;
  for (const auto& [room, least] : {Case{small, 0.33}, Case{dimmed, 0.5}}) {
    Session session(Room(), poolOf(73728));
    session.edit(room);
    const StatePages fresh = session.fresh();
    const auto all = static_cast<double>(session.hitsAmiss(fresh));
    for (int i = 0; i < 9; ++i) session.step(8);
    EXPECT_GT(1 - static_cast<double>(session.hitsAmiss(fresh)) / all, least);
  }
}

// Each unit takes another row, and one that is not yet right.
TEST(Selective, UnitsOfAStepShareNoRow) {
  Session session{Room()};
  Room room;
  room.box.x = -0.2f;
  session.edit(room);
  const StatePages fresh = session.fresh();
  size_t before = session.differing(fresh).size();
  for (int i = 0; i < 38; ++i) {
    session.step(8);
    const size_t left = session.differing(fresh).size();
    EXPECT_EQ(left, before - 8);
    before = left;
  }
  for (uint32_t g = 0; g < 288; ++g) EXPECT_GE(GroupPages::priority(session.pages(), g), 0);
}

// A wall without thickness between a lit and a dark room: its dark face and whatever lies further
// than an element from it get nothing at all.
TEST(Selective, LightStaysOnItsSideOfAThinWall) {
  SceneBuilder b;
  const int grey = b.material(testing::matte(Vec3(0.7f)));
  b.box(grey, Vec3(-1), Vec3(1), true);
  b.quad(grey, Vec3(0, -1, -1), Vec3(0, 2, 0), Vec3(0, 0, 2));
  PunctualLight light;
  light.position = Vec3(-0.5f, 0, 0), light.intensity = Vec3(2);
  b.light(light);
  const Metres h = 0.1f;
  const auto seen = [&](Vec3 eye, Vec3 target) {
    const Scene scene = SceneBuilder(b).camera(eye, target, 0.2f).build();
    const Tracer tracer(scene, Isa::automatic);
    Settings s = poolOf();
    s.elementSize = h / scene.bounds.radius();
    return testing::render(tracer, s, 2);
  };
  for (const Vec3& p : seen(Vec3(0.9f, 0, 0), Vec3(0)).pixels) EXPECT_EQ(p, Vec3(0));
  for (const Vec3& p : seen(Vec3(0.6f, 0, 0), Vec3(0.6f, -1, 0.01f)).pixels) EXPECT_EQ(p, Vec3(0));
  for (const Vec3& p : seen(Vec3(-0.9f, 0, 0), Vec3(0)).pixels) EXPECT_GT(p.x, 0.05f);
}

// The finer the elements, the nearer to the truth, down to the noise of the photons: against the
// reference in a room whose light changes fast near the box.
TEST(Selective, FinerElementsBlurLess) {
  const Scene scene = Room().build();
  const Tracer tracer(scene, Isa::automatic);
  Settings truth = testing::small(Method::instantRadiosity, 24);
  truth.directVpls = 16, truth.indirectVpls = 64;
  const auto wanted = testing::render(tracer, truth, 256);
  const auto errorOf = [&](float size) {
    Settings s = poolOf(73728);
    s.width = s.height = 24, s.elementSize = size, s.directVpls = 16;
    const auto found = testing::render(tracer, s, 24);
    double sum = 0;
    for (size_t i = 0; i < found.pixels.size(); ++i) {
      const auto off = static_cast<double>(found.pixels[i].x - wanted.pixels[i].x);
      sum += off * off;
    }
    return std::sqrt(sum / static_cast<double>(found.pixels.size())) / wanted.grey();
  };
  const double coarse = errorOf(0.6f), fine = errorOf(0.1f);
  EXPECT_LT(fine, 0.7 * coarse);
  EXPECT_LT(fine, 0.03);
}

}  // namespace
}  // namespace ninefold
