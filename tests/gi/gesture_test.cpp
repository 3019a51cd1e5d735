// While a gesture lasts, sample streams belong to lamps and to pairs of a lamp and a specular
// object: what is done to one of them leaves the samples of the others as they are, bit for bit,
// and no energy is lost or added.
#include <gtest/gtest.h>

#include "common/gi/radiosity/radiosity.h"
#include "common/scene/edit.h"
#include "common/scene/methods.h"
#include "tests/gi/make_scene.h"
#include "tests/gi/render.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

constexpr int kSets = 4;
// Nodes and materials in the order of twoHalves.
constexpr int kLeftGlass = 4, kRightGlass = 5, kBox = 6;
constexpr uint32_t kLeftLampsMaterial = 2, kRightLampsMaterial = 3;
constexpr uint32_t kPoint = 0, kSpot = 1;

PunctualLight punctual(LightKind kind, Vec3 position, float intensity) {
  PunctualLight light;
  light.kind = kind, light.position = position, light.intensity = Vec3(intensity);
  light.direction = glm::normalize(Vec3(0.2f, -1, 0));
  return light;
}

// A room in two halves, a wall between them; in each a lamp, a glass ball, and a punctual light.
// In the left half, which the camera sees, a box that is not quite rough.
Scene twoHalves() {
  SceneBuilder b;
  const int grey = b.material(testing::matte(Vec3(0.6f)));
  const int glass = b.material(testing::glass(1.5f));
  const int left = b.material(testing::matte(Vec3(0), Vec3(10)));
  const int right = b.material(testing::matte(Vec3(0), Vec3(10)));
  Material glossy = testing::mirror(Vec3(0.7f));
  glossy.roughness = 0.4f;
  const int dull = b.material(glossy);
  b.box(grey, Vec3(-4, -1.5f, -1.5f), Vec3(4, 1.5f, 1.5f), true);
  b.box(grey, Vec3(-0.05f, -1.5f, -1.5f), Vec3(0.05f, 1.5f, 1.5f), false);
  b.quad(left, Vec3(-1.3f, 1.49f, -0.3f), Vec3(0.6f, 0, 0), Vec3(0, 0, 0.6f));
  b.quad(right, Vec3(0.7f, 1.49f, -0.3f), Vec3(0.6f, 0, 0), Vec3(0, 0, 0.6f));
  b.sphere(glass, Vec3(-2.5f, -1, 0), 0.4f, 12);
  b.sphere(glass, Vec3(2.5f, -1, 0), 0.4f, 12);
  b.box(dull, Vec3(-2, -1.4f, 0.8f), Vec3(-1.5f, -0.9f, 1.3f), false);
  b.light(punctual(LightKind::point, Vec3(-2, 0.5f, -1), 3));
  b.light(punctual(LightKind::spot, Vec3(2, 1, 0), 5));
  b.camera(Vec3(-0.5f, 0, 1.2f), Vec3(-2.4f, -0.6f, -0.3f), 1.2f);
  return b.build();
}

// Edits, one on top of another.
class State {
 public:
  State& glow(uint32_t material, float radiance) {
    MaterialEdit e = editOfMaterial(scene_, material);
    e.emission = Vec3(radiance);
    return with({{}, {}, {e}, {}});
  }
  State& shine(uint32_t light, float intensity) {
    LightEdit e = editOf(scene_, light);
    e.intensity = Vec3(intensity);
    return with({{}, {e}, {}, {}});
  }
  State& move(int node, DVec3 by) {
    ObjectEdit e{node, DMat4(1)};
    e.motion[3] = DVec4(by, 1);
    return with({{e}, {}, {}, {}});
  }
  const Scene& scene() const { return scene_; }

 private:
  State& with(const SceneEdit& edit) {
    merge(all_, edit);
    scene_ = edited(asRead_, all_);
    return *this;
  }
  const Scene asRead_ = twoHalves();
  Scene scene_ = asRead_;
  SceneEdit all_;
};

bool same(const Vpl& a, const Vpl& b) {
  return a.position == b.position && a.normal == b.normal && a.power == b.power &&
         a.bound == b.bound && a.error == b.error;
}
bool same(const Photon& a, const Photon& b) {
  return a.position == b.position && a.normal == b.normal && a.flux == b.flux;
}

// All of a few sets: what lights are seen by, and the photons on their paths.
struct Samples {
  std::vector<Vpl> vpls;
  std::vector<Photon> photons;
};

// Of the state that `begun` became, or, without it, of a scene at rest.
Samples samplesOf(const Scene& now, const Scene* begun) {
  Settings settings;
  settings.caustics = Caustics::direct;
  const Tracer tracer(now, Isa::automatic);
  std::unique_ptr<Tracer> then;
  std::unique_ptr<Renderer> renderer;
  if (begun != nullptr) {
    then = std::make_unique<Tracer>(*begun, Isa::automatic);
    renderer = std::make_unique<Renderer>(*then, settings);
  }
  const Renderer gesture(tracer, settings, renderer.get());
  Samples samples;
  for (int k = 0; k < kSets; ++k) {
    const auto light = gesture.light(FrameKey{0, 0, 0, 0.05f}, k);
    const auto* set = dynamic_cast<const LightSet*>(light.get());
    if (set == nullptr) throw std::logic_error("the light is no light set");
    samples.vpls.insert(samples.vpls.end(), set->vpls.begin(), set->vpls.end());
    for (const PhotonGrid& grid : set->photons)
      samples.photons.insert(samples.photons.end(), grid.photons().begin(), grid.photons().end());
  }
  return samples;
}

// How many elements of `some` are in `all`.
template <typename T>
size_t found(const std::vector<T>& some, const std::vector<T>& all) {
  return static_cast<size_t>(std::ranges::count_if(some, [&](const T& x) {
    return std::ranges::any_of(all, [&](const T& y) { return same(x, y); });
  }));
}

void expectAllIn(const Samples& some, const Samples& all, const char* what) {
  EXPECT_EQ(found(some.vpls, all.vpls), some.vpls.size()) << what;
  EXPECT_EQ(found(some.photons, all.photons), some.photons.size()) << what;
  EXPECT_GT(some.vpls.size(), 20u) << what;
  EXPECT_GT(some.photons.size(), 200u) << what;
}

TEST(Gesture, WhatIsDoneToALampLeavesTheSamplesOfTheOthers) {
  const Scene begun = State().scene();
  const Samples others = samplesOf(State().glow(kLeftLampsMaterial, 0).scene(), &begun);
  const Samples all = samplesOf(begun, nullptr);
  expectAllIn(others, all, "a lamp goes out");
  EXPECT_LT(others.vpls.size(), 0.9 * double(all.vpls.size()));
  const Scene brighter = State().glow(kLeftLampsMaterial, 40).scene();
  expectAllIn(others, samplesOf(brighter, &begun), "it brightens");
  EXPECT_LT(found(others.vpls, samplesOf(brighter, nullptr).vpls), others.vpls.size() / 2);
  constexpr int kLeftLamp = 2;
  expectAllIn(others, samplesOf(State().move(kLeftLamp, DVec3(0.3, 0, 0.2)).scene(), &begun),
              "it moves");
  const Samples withoutSpot = samplesOf(State().shine(kSpot, 0).scene(), &begun);
  expectAllIn(withoutSpot, all, "a spot goes out");
  expectAllIn(withoutSpot, samplesOf(State().shine(kSpot, 50).scene(), &begun), "it brightens");
}

TEST(Gesture, ALampThatWasOffComesBesideTheOthers) {
  const Scene begun = State().glow(kRightLampsMaterial, 0).shine(kPoint, 0).scene();
  const Samples before = samplesOf(begun, nullptr);
  const Samples one = samplesOf(State().glow(kRightLampsMaterial, 0).scene(), &begun);
  expectAllIn(before, one, "a point light goes on");
  EXPECT_GT(one.vpls.size(), before.vpls.size());
  const Samples two = samplesOf(State().scene(), &begun);
  expectAllIn(before, two, "so does a lamp");
  EXPECT_GT(two.vpls.size(), one.vpls.size());
}

// The lamps' rays into the other half miss both glasses, and cones of theirs do not overlap.
TEST(Gesture, AGlassThatMovesLeavesThePhotonsOfAnother) {
  const Scene begun = State().scene();
  const Scene moved = State().move(kRightGlass, DVec3(0.6, 0.3, -0.7)).scene();
  const auto leftOnes = [](std::vector<Photon> photons) {
    std::erase_if(photons, [](const Photon& p) { return p.position.x > 0; });
    return photons;
  };
  const std::vector<Photon> left = leftOnes(samplesOf(begun, nullptr).photons);
  const std::vector<Photon> after = leftOnes(samplesOf(moved, &begun).photons);
  ASSERT_GT(left.size(), 200u);
  EXPECT_EQ(found(left, after), left.size());
  EXPECT_EQ(left.size(), after.size());
  EXPECT_LT(found(left, leftOnes(samplesOf(moved, nullptr).photons)), left.size() / 2);
  EXPECT_NE(samplesOf(begun, nullptr).photons.size(), samplesOf(moved, &begun).photons.size());
}

TEST(Gesture, BoundAndPhotonsStayWhereSomethingLeadsOutOfTheScene) {
  const Scene begun = State().scene(), grown = State().move(kBox, DVec3(-4, 0, 0)).scene();
  ASSERT_GT(coverRadius(grown), 1.05f * coverRadius(begun));
  const Tracer then(begun, Isa::automatic), now(grown, Isa::automatic);
  const Settings settings;
  const Transport atRest(then, settings), gesture(now, settings, &atRest), after(now, settings);
  EXPECT_EQ(gesture.bound, atRest.bound);
  EXPECT_EQ(after.bound, atRest.bound);
  EXPECT_EQ(gesture.farRounding, after.farRounding);  // what rounding may do is not ours to choose
  const PhotonRadii radiiThen(atRest, 0.05f), radiiNow(gesture, 0.05f);
  for (float flux = 1e-6f; flux < 1e3f; flux *= 1.5f)
    EXPECT_EQ(radiiNow.choose(Flux(flux)), radiiThen.choose(Flux(flux)));
}

// The mean picture is the same with and without what a gesture freezes.
void expectSameLight(const Scene& begun, const Scene& now, const char* what) {
  const Tracer then(begun, Isa::automatic), tracer(now, Isa::automatic);
  for (const MethodFacts& facts : allMethods()) {
    Settings settings = testing::small(facts.method, 16);
    settings.seed = 3;
    constexpr int kFrames = 64;
    const auto gesture = testing::render(tracer, settings, kFrames, &then);
    settings.seed = 4;
    const auto rest = testing::render(tracer, settings, kFrames);
    const double error = std::hypot(gesture.error(), rest.error());
    EXPECT_NEAR(gesture.grey(), rest.grey(), 4 * error)
        << facts.name << ", " << what << " +- " << error;
    EXPECT_LT(error, 0.03 * rest.grey()) << facts.name << ", " << what;
    EXPECT_GT(rest.grey(), 0) << facts.name << ", " << what;
  }
}

const Scene& withoutPoint() {
  static const Scene scene = State().shine(kPoint, 0).scene();
  return scene;
}

TEST(Gesture, NoEnergyIsLostOrAddedWhenALightGoesOn) {
  expectSameLight(withoutPoint(), State().shine(kPoint, 9).scene(), "a light goes on");
}

TEST(Gesture, NoEnergyIsLostOrAddedWhenALampDims) {
  expectSameLight(withoutPoint(), State().shine(kPoint, 0).glow(kLeftLampsMaterial, 2).scene(),
                  "a lamp dims");
}

TEST(Gesture, NoEnergyIsLostOrAddedWhenAllButOneGoOff) {
  expectSameLight(withoutPoint(), State().glow(kLeftLampsMaterial, 0).shine(kSpot, 0).scene(),
                  "all that was on goes off but for one");
}

TEST(Gesture, NoEnergyIsLostOrAddedWhenGlassMoves) {
  expectSameLight(withoutPoint(),
                  State().shine(kPoint, 0).move(kLeftGlass, DVec3(0.6, 0.9, 0.2)).scene(),
                  "a glass goes under the lamp");
}

// Nothing but highlights: lights that are sampled at the S vertices of eye paths.
TEST(Gesture, HighlightsOfALightThatGoesOn) {
  SceneBuilder b;
  Material glossy = testing::mirror(Vec3(0.7f));
  glossy.roughness = 0.4f;
  b.quad(b.material(glossy), Vec3(-2, 0, 2), Vec3(4, 0, 0), Vec3(0, 0, -4));
  b.quad(b.material(testing::matte(Vec3(0), Vec3(1))), Vec3(-1, 2, -1), Vec3(1, 0, 0),
         Vec3(0, 0, 1));
  b.light(punctual(LightKind::point, Vec3(0.5f, 1, 0), 0));
  b.camera(Vec3(0, 1, 1.5f), Vec3(0, 0, -0.5f));
  const Scene dark = b.build();
  LightEdit on = editOf(dark, 0);
  on.intensity = Vec3(2);
  expectSameLight(dark, edited(dark, {{}, {on}, {}, {}}), "a light over metal");
}

TEST(Gesture, ThatBeganInTheDarkGoesByWhatIsThere) {
  const Scene dark = State()
                         .shine(kPoint, 0)
                         .shine(kSpot, 0)
                         .glow(kLeftLampsMaterial, 0)
                         .glow(kRightLampsMaterial, 0)
                         .scene();
  const Scene now = State().scene();
  const Samples samples = samplesOf(now, &dark), rest = samplesOf(now, nullptr);
  expectAllIn(samples, rest, "on");
  expectAllIn(rest, samples, "on");
  EXPECT_TRUE(samplesOf(dark, &now).vpls.empty());
}

}  // namespace
}  // namespace ninefold
