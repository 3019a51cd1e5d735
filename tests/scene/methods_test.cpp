#include "common/scene/methods.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <string>

#include "common/image/layers.h"
#include "tests/scene/one_material.h"

namespace ninefold {
namespace {

Settings settingsOf(const MethodFacts& facts) {
  Settings s;
  s.method = facts.method;
  return s;
}

TEST(Methods, EachHasARowInTheOrderOfTheirNumbers) {
  std::set<std::string> names, titles;
  size_t number = 0;
  for (const MethodFacts& facts : allMethods()) {
    EXPECT_EQ(static_cast<size_t>(facts.method), number++);
    EXPECT_EQ(&factsOf(facts.method), &facts);
    EXPECT_TRUE(names.insert(facts.name).second) << facts.name << " is there twice";
    EXPECT_TRUE(titles.insert(facts.title).second) << facts.title << " is there twice";
    EXPECT_EQ(std::string(facts.name).find_first_not_of("abcdefghijklmnopqrstuvwxyz-"),
              std::string::npos)
        << facts.name << " is a word of the command line";
    const bool isDefault = facts.method == Settings{}.method;
    EXPECT_NE(describeMethods().find(facts.name), std::string::npos);
    EXPECT_NE(describeMethods().find(isDefault ? "(default)" : facts.help), std::string::npos)
        << facts.name;
  }
}

// A tracer's radiance is finished: one layer, whatever the scene has.
TEST(Methods, UnfilteredRadianceIsOneLayer) {
  Needs needs;
  needs.reflection = needs.transmission = true;
  for (const MethodFacts& facts : allMethods())
    EXPECT_EQ(layerMaskOf(needs, facts.method),
              facts.isUnfiltered ? kDiffuseBit : kDiffuseBit | kReflectionBit | kTransmissionBit)
        << facts.name;
}

TEST(Methods, PhotonsNeedAMethodThatHasThemAndASceneThatFocuses) {
  Needs focusing;
  focusing.caustics = true;
  for (const MethodFacts& facts : allMethods()) {
    Settings s = settingsOf(facts);
    EXPECT_EQ(usesPhotons(focusing, s), facts.has(kCausticPhotons)) << facts.name;
    EXPECT_FALSE(usesPhotons(Needs{}, s)) << facts.name;
    s.photons = 0;
    EXPECT_FALSE(usesPhotons(focusing, s)) << facts.name;
    s.photons = 1, s.caustics = Caustics::off;
    EXPECT_FALSE(usesPhotons(focusing, s)) << facts.name;
  }
}

// A set that costs nothing has no rays of its own: then rays are in proportion to the pixels.
TEST(Methods, RaysOfATaskAreThoseOfItsPixelsAndOfItsSet) {
  for (const MethodFacts& facts : allMethods()) {
    Settings s = settingsOf(facts);
    const double none = facts.rays(s, 0), one = facts.rays(s, 1), ten = facts.rays(s, 10);
    EXPECT_EQ(none == 0, facts.freeSets) << facts.name;
    EXPECT_GT(one, none) << facts.name;
    EXPECT_DOUBLE_EQ(ten - none, 10 * (one - none)) << facts.name;
    s.photons += 5;
    EXPECT_EQ(facts.rays(s, 1) > one, facts.has(kCausticPhotons)) << facts.name;
  }
}

TEST(Methods, LightIsSharedByViewsUnlessItIsMadeForOne) {
  for (const MethodFacts& facts : allMethods()) {
    const Settings s = settingsOf(facts);
    Settings other = s;
    other.camera.eye.x += 1, other.width = 7, other.height = 5;
    EXPECT_TRUE(haveSameLight(s, s)) << facts.name;
    EXPECT_EQ(haveSameLight(s, other), !facts.lightNeedsView) << facts.name;
    other = s, other.seed += 1;
    EXPECT_FALSE(haveSameLight(s, other)) << facts.name;
  }
}

// A state is kept while what it is made of stays: the camera, what is asked of it, and light that
// it has no part in may change.
TEST(Methods, AStateIsKeptUnderOtherViewsAndBegunAnewForOtherSeeds) {
  for (const MethodFacts& facts : allMethods()) {
    if (facts.state == nullptr || facts.state->servesAll()) continue;
    const Settings s = settingsOf(facts);
    EXPECT_GE(facts.state->unitsOfAll(s), facts.state->unitsInMotion(s)) << facts.name;
    EXPECT_GE(facts.state->unitsInMotion(s), 1u) << facts.name;
    EXPECT_GT(facts.state->rays(s), 0) << facts.name;
    Settings other = s;
    other.camera.eye.x += 1, other.width = 7, other.height = 5, other.jitter = false;
    other.interleave = {1, 1}, other.photons += 1, other.caustics = Caustics::off;
    EXPECT_TRUE(facts.state->isKept(s, other)) << facts.name;
    for (const auto& change : std::vector<std::function<void(Settings&)>>{
             [](Settings& o) { o.seed += 1; }, [](Settings& o) { o.pathLength = 3; },
             [](Settings& o) { o.environment = Radiance(1); },
             [](Settings& o) { o.method = Method::instantRadiosity; }}) {
      other = s;
      change(other);
      EXPECT_FALSE(facts.state->isKept(s, other)) << facts.name;
    }
  }
}

// What a trial chose stays right whatever is changed: each of the methods finds all light.
TEST(Methods, AChoiceIsKeptUnderAllSettings) {
  const StateFacts& trial = *factsOf(Method::automatic).state;
  Settings s, other;
  other.seed += 1, other.pathLength = 3, other.environment = Radiance(1);
  EXPECT_TRUE(trial.isKept(s, other));
  EXPECT_TRUE(trial.beginsAnew);
  EXPECT_GT(trial.unitsOfAll(s), 1u);
}

TEST(Methods, ThePoolGoesByTheSettingsOfItsPhotons) {
  const MethodFacts& facts = factsOf(Method::photonMap);
  const Settings s = settingsOf(facts);
  EXPECT_EQ(facts.state->unitsOfAll(s), 20u);
  const auto isKept = [&](const std::function<void(Settings&)>& change, Settings before) {
    Settings after = before;
    change(after);
    return facts.state->isKept(before, after);
  };
  EXPECT_TRUE(isKept([](Settings& o) { o.mapNearest = 50, o.mapDistance = 0.1f; }, s));
  EXPECT_TRUE(isKept([](Settings& o) { o.mapIndex = MapIndex::tree, o.directVpls = 0; }, s));
  EXPECT_TRUE(isKept([](Settings& o) { o.mapEstimate = MapEstimate::vertices; }, s));
  EXPECT_TRUE(isKept([](Settings& o) { o.mapSubdivision = 5; }, s));
  EXPECT_FALSE(isKept([](Settings& o) { o.mapPhotons = 4000; }, s));
  EXPECT_FALSE(isKept([](Settings& o) { o.mapPerFrame = 200; }, s));
  EXPECT_FALSE(isKept([](Settings& o) { o.mapDistribution = MapDistribution::turn; }, s));
  EXPECT_FALSE(isKept([](Settings& o) { o.mapDirect = MapDirect::on; }, s));
  Settings direct = s;
  direct.mapDirect = MapDirect::on;  // no direct VPLs means no direct light
  EXPECT_FALSE(isKept([](Settings& o) { o.directVpls = 0; }, direct));
  EXPECT_TRUE(isKept([](Settings& o) { o.directVpls = 5; }, direct));
}

TEST(Methods, GroupsGoByTheSettingsOfTheirPhotons) {
  const MethodFacts& facts = factsOf(Method::selective);
  const Settings s = settingsOf(facts);
  EXPECT_EQ(facts.state->unitsOfAll(s), 306u);
  EXPECT_EQ(facts.state->unitsInMotion(s), 64u);
  const auto isKept = [&](const std::function<void(Settings&)>& change) {
    Settings after = s;
    change(after);
    return facts.state->isKept(s, after);
  };
  EXPECT_TRUE(isKept([](Settings& o) { o.elementSize = 0.1f, o.directVpls = 0; }));
  EXPECT_TRUE(isKept([](Settings& o) { o.elementRule = ElementRule::buckets, o.photons = 0; }));
  EXPECT_FALSE(isKept([](Settings& o) { o.photonPool = 294912; }));
  EXPECT_FALSE(isKept([](Settings& o) { o.photonGroups = 576; }));
  EXPECT_FALSE(isKept([](Settings& o) { o.pilotRatio = 32; }));
  EXPECT_FALSE(isKept([](Settings& o) { o.specularDepth = 2; }));
  EXPECT_FALSE(isKept([](Settings& o) { o.minorLamps = 0.1f; }));
}

// Without virtual lights there is no direct light, whoever would bring it.
TEST(Methods, GroupsGoByTheDirectLightOfMinorLamps) {
  Settings s = settingsOf(factsOf(Method::selective));
  s.minorLamps = 0.5f;
  Settings dark = s, fewer = s;
  dark.directVpls = 0, fewer.directVpls = 1;
  EXPECT_FALSE(factsOf(s.method).state->isKept(s, dark));
  EXPECT_TRUE(factsOf(s.method).state->isKept(s, fewer));
}

TEST(Methods, FieldsGoByTheSettingsOfTheirPhotonsAndLines) {
  const MethodFacts& facts = factsOf(Method::intersectionField);
  Settings s = settingsOf(facts);
  EXPECT_EQ(facts.state->unitsOfAll(s), 256u);
  EXPECT_EQ(facts.state->unitsInMotion(s), 64u);
  s.fieldPhotons = 1000;
  EXPECT_EQ(facts.state->unitsOfAll(s), 4u);
  EXPECT_EQ(facts.state->unitsInMotion(s), 4u);
  const auto isKept = [&](const std::function<void(Settings&)>& change) {
    Settings after = s;
    change(after);
    return facts.state->isKept(s, after);
  };
  EXPECT_TRUE(isKept([](Settings& o) { o.fieldDirect = FieldDirect::field, o.directVpls = 0; }));
  EXPECT_TRUE(isKept([](Settings& o) { o.elementRule = ElementRule::buckets, o.photons = 0; }));
  EXPECT_FALSE(isKept([](Settings& o) { o.fieldDirections = 17; }));
  EXPECT_FALSE(isKept([](Settings& o) { o.fieldDistances = 33; }));
  EXPECT_FALSE(isKept([](Settings& o) { o.fieldPhotons = 2000; }));
  EXPECT_FALSE(isKept([](Settings& o) { o.elementSize = 0.1f; }));
  EXPECT_FALSE(isKept([](Settings& o) { o.specularDepth = 2; }));
}

// Without photons no eye path meets a point by chance: what comes from one by a smooth surface is
// missing, and said to be; rough lobes sample lights, area lights are met.
TEST(LeftOut, MethodsThatMissTheCausticsOfPunctualLightsNameThem) {
  Settings settings;
  const auto lines = [&](float roughness, bool punctual) {
    Material metal;
    metal.roughness = roughness, metal.emission = Vec3(1);
    Scene scene = withMaterial(metal);
    if (punctual) scene.lights.emplace_back();
    return leftOut(needsOf(scene, Radiance(1)), settings);
  };
  for (const MethodFacts& facts : allMethods()) {
    settings.method = facts.method;
    ASSERT_EQ(lines(0, true).size(), facts.missesPunctualCaustics ? 1u : 0u) << facts.name;
    for (const std::string& line : lines(0, true))
      EXPECT_EQ(line.find(std::string(facts.name) + " cannot find"), 0u) << line;
    EXPECT_TRUE(lines(0.3f, true).empty()) << facts.name;
    EXPECT_TRUE(lines(0, false).empty()) << facts.name;
  }
}

TEST(LeftOut, FewerCausticsAreNamedIfThereAreAny) {
  Settings settings;
  Material glass = matte();
  glass.transmission = 1;
  for (const Caustics caustics : {Caustics::off, Caustics::direct, Caustics::all}) {
    settings.caustics = caustics;
    EXPECT_EQ(leftOut(needsWith(glass), settings).size(), caustics == Caustics::all ? 0u : 1u);
    EXPECT_TRUE(leftOut(needsWith(matte()), settings).empty());
  }
  settings.photons = 0;
  EXPECT_EQ(leftOut(needsWith(glass), settings).size(), 1u);
}

}  // namespace
}  // namespace ninefold
