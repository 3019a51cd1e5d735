// Settings that are each within range, and too much together for a method with reverse VPLs, or of
// no use for one with a pool of photons; and what a scene is too large for.
#include "common/scene/settings_check.h"

#include <gtest/gtest.h>

#include <functional>
#include <tuple>

#include "common/base/error.h"
#include "common/scene/methods.h"

namespace ninefold {
namespace {

// What is said against settings of the method; empty: nothing.
std::string refusal(const MethodFacts& facts, const std::function<void(Settings&)>& spoil) {
  Settings s;
  s.method = facts.method;
  spoil(s);
  try {
    checkTogether(s);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(SettingsCheck, SaysWhatIsTooMuchAndWhatToLower) {
  const std::pair<const char*, std::function<void(Settings&)>> cases[] = {
      {"lower --resampling", [](Settings& s) { s.resampling = 1000, s.directVpls = 65536; }},
      {"lower --camera-points", [](Settings& s) { s.directVpls = 20000, s.cameraPoints = 4096; }},
      {"path-length is 65", [](Settings& s) { s.pathLength = 65; }},
  };
  for (const MethodFacts& facts : allMethods())
    for (const auto& [text, spoil] : cases) {
      const std::string said = refusal(facts, spoil);
      if (facts.has(kReverseVpls))
        EXPECT_NE(said.find(text), std::string::npos) << facts.name << ": " << said;
      else
        EXPECT_EQ(said, "") << facts.name;
    }
}

TEST(SettingsCheck, APoolIsRenewedInEqualParts) {
  const std::tuple<int, int, const char*> cases[] = {
      {2000, 3000,
       "map-photons-per-frame is 3000, more than all 2000 of the pool: lower it, or "
       "raise --map-photons"},
      {2000, 90,
       "map-photons-per-frame is 90 and does not divide the 2000 of the pool: 80 would "
       "do"},
      {200000, 2,
       "the pool has 100000 parts of 2 photons, at most are 65536: raise "
       "--map-photons-per-frame"},
      {2000, 2000, ""},
      {7, 1, ""}};
  for (const MethodFacts& facts : allMethods())
    for (const auto& [photons, perFrame, text] : cases) {
      const std::string said =
          refusal(facts, [&](Settings& s) { s.mapPhotons = photons, s.mapPerFrame = perFrame; });
      EXPECT_EQ(said, facts.has(kMapPhotons) ? text : "") << facts.name;
    }
}

TEST(SettingsCheck, GroupsOfPhotonsFitTogether) {
  const std::tuple<int, int, int, const char*> cases[] = {
      {147456, 286, 16,
       "photon-groups is 286: it must be a product of 2, 3, 5 and 7, as 288 or 10080 is"},
      {147456, 11, 16,
       "photon-groups is 11: it must be a product of 2, 3, 5 and 7, as 288 or 10080 is"},
      {150000, 288, 16,
       "photon-pool is 150000, no multiple of photon-groups 288 times pilot-ratio 16: 152064 would "
       "do"},
      {10, 288, 16,
       "photon-pool is 10, no multiple of photon-groups 288 times pilot-ratio 16: 4608 would do"},
      {4194304, 20160, 4096,
       "photon-groups 20160 times pilot-ratio 4096 is more than a pool can have: lower one"},
      {147456, 8, 16, "a group has 18432 of the photons, at most are 16384: raise --photon-groups"},
      {161280, 10080, 16, ""},
      {16, 1, 16, ""}};
  for (const MethodFacts& facts : allMethods())
    for (const auto& [photons, groups, ratio, text] : cases) {
      const std::string said = refusal(facts, [&](Settings& s) {
        s.photonPool = photons, s.photonGroups = groups, s.pilotRatio = ratio;
      });
      EXPECT_EQ(said, facts.has(kElementPhotons) ? text : "") << facts.name;
    }
}

TEST(SettingsCheck, LinesOfAFieldHaveNoDivisorInCommon) {
  const std::tuple<int, int, const char*> cases[] = {
      {12, 32,
       "field-directions 12 and field-distances 32 have the divisor 4 in common, which focuses the "
       "lines in some places: 31 distances would do"},
      {6, 2,
       "field-directions 6 and field-distances 2 have the divisor 2 in common, which focuses the "
       "lines in some places: 5 distances would do"},
      {76, 127, ""},
      {19, 32, ""},
      {2, 3, ""}};
  for (const MethodFacts& facts : allMethods())
    for (const auto& [directions, distances, text] : cases) {
      const std::string said = refusal(facts, [&](Settings& s) {
        s.fieldDirections = directions, s.fieldDistances = distances;
      });
      EXPECT_EQ(said, facts.has(kFieldPhotons) ? text : "") << facts.name;
    }
}

// Whatever the method: a window may choose another one.
TEST(SettingsCheck, LightAtVerticesFitsTheScene) {
  const std::tuple<size_t, int, const char*> cases[] = {
      {100, 6, ""},
      {128 << 4, 6, ""},
      {(128 << 4) + 1, 6,
       "map-subdivision is 6: the scene's 2049 triangles become 8392704, at most are 8388608: 5 "
       "would do"},
      {40000, 6,
       "map-subdivision is 6: the scene's 40000 triangles become 163840000, at most are 8388608: "
       "3 would do"},
      {9000000, 0,
       "map-subdivision is 0: the scene's 9000000 triangles become 9000000, at most are 8388608: "
       "use --map-estimate pixels"}};
  for (const auto& [triangles, levels, text] : cases) {
    Mesh mesh;
    mesh.triangles.resize(triangles - 3 * (triangles / 4));
    Scene scene;
    Mesh rest;
    rest.triangles.resize(triangles / 4);
    scene.meshes = {mesh, rest};
    scene.instances.resize(4);
    for (size_t i = 1; i < 4; ++i) scene.instances[i].mesh = 1;
    Settings s;
    s.mapSubdivision = levels;
    EXPECT_NO_THROW(checkWith(scene, s));
    s.mapEstimate = MapEstimate::vertices;
    std::string said;
    try {
      checkWith(scene, s);
    } catch (const Error& error) {
      said = error.what();
    }
    EXPECT_EQ(said, text);
  }
}

TEST(SettingsCheck, TakesWhatIsUsual) {
  for (const MethodFacts& facts : allMethods()) {
    EXPECT_EQ(refusal(facts, [](Settings&) {}), "") << facts.name;
    EXPECT_EQ(refusal(facts, [](Settings& s) { s.resampling = 100, s.pathLength = 64; }), "");
  }
}

}  // namespace
}  // namespace ninefold
