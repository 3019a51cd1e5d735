// Goniometric lights of glTF files: where profiles come from, how they lie in their nodes, and that
// they are saved, edited and played as they are.
#include "common/scene/gltf_profiles.h"

#include <gtest/gtest.h>

#include "common/scene/animation.h"
#include "common/scene/emitters.h"
#include "common/scene/gltf_writer.h"
#include "common/scene/reader.h"
#include "tests/scene/gltf_bytes.h"
#include "tests/scene/ies_text.h"
#include "tests/scene/one_line_error.h"
#include "tests/scene/same_scene.h"
#include "tests/scene/temp_folder.h"

namespace ninefold {
namespace {

// 0 at the axis, and the horizontal angle's tenth on the horizon, in candela.
IesText uneven() {
  IesText file;
  file.vertical = {0, 90}, file.horizontal = {0, 90, 180, 270, 360};
  file.candela = [](double v, double h) { return v == 0 ? 40 : h == 360 ? 0 : h / 10; };
  return file;
}

std::string percentEncoded(const std::string& text) {
  std::string out;
  for (const char c : text) {
    constexpr const char* kDigits = "0123456789ABCDEF";
    out += '%', out += kDigits[(c >> 4) & 15], out += kDigits[c & 15];
  }
  return out;
}

std::string dataUri(const IesText& file) {
  return "data:application/x-ies-lm-63," + percentEncoded(file.text());
}

// The triangle and nodes with lights; `lights`: the extension's list.
class Lamps {
 public:
  explicit Lamps(std::string lights) : lights_(std::move(lights)) {}
  static Lamps of(const IesText& file) { return Lamps(R"({"uri": ")" + dataUri(file) + "\"}"); }

  Lamps& add(const std::string& use, const std::string& node = "") {
    nodes_ += R"(, {"name": "lamp", )" + node + R"("extensions": {"EXT_lights_ies": )" + use + "}}";
    roots_ += ", " + std::to_string(++count_);
    return *this;
  }
  Lamps& with(const std::string& more) {
    more_ = more;
    return *this;
  }
  std::string json() const {
    std::string json = ninefold::with(kTriangleJson, R"("mesh": 0})", R"("mesh": 0})" + nodes_);
    json = ninefold::with(json, R"("nodes": [0])", R"("nodes": [0)" + roots_ + "]");
    return ninefold::with(json, R"("materials")",
                          R"("extensions": {"EXT_lights_ies": {"lights": [)" + lights_ + "]}" +
                              more_ + R"(}, "extensionsUsed": ["EXT_lights_ies"], "materials")");
  }
  Scene read() const {
    const TempFolder folder;
    return readScene(folder.write("scene.glb", triangleGlb(json())));
  }

 private:
  std::string lights_, nodes_, roots_, more_;
  int count_ = 0;
};

float candelaTo(const Scene& scene, Vec3 w) {
  return Emitters::intensity(scene, scene.lights.at(0), glm::normalize(w)).x;
}

TEST(GltfProfiles, AnUnturnedLampAimsAlongMinusZAndCountsFromXToY) {
  const Scene scene = Lamps::of(uneven()).add(R"({"light": 0})").read();
  ASSERT_EQ(scene.lights.size(), 1u);
  const PunctualLight& light = scene.lights[0];
  EXPECT_EQ(light.kind, LightKind::goniometric);
  EXPECT_EQ(light.name, "lamp");
  EXPECT_EQ(light.direction, Vec3(0, 0, -1));
  EXPECT_EQ(light.across, Vec3(1, 0, 0));
  EXPECT_EQ(light.intensity, Vec3(40));
  EXPECT_EQ(scene.environment, Radiance(0)) << "it is a light: no white outside";
  EXPECT_NEAR(candelaTo(scene, Vec3(0, 0, -1)), 40, 1e-4f);
  EXPECT_NEAR(candelaTo(scene, Vec3(0, 1, 0)), 9, 1e-4f);
  EXPECT_NEAR(candelaTo(scene, Vec3(-1, 0, 0)), 18, 1e-4f);
  EXPECT_NEAR(candelaTo(scene, Vec3(0, -1, 0)), 27, 1e-4f);
  EXPECT_EQ(candelaTo(scene, Vec3(0, 0, 1)), 0);
}

// A quarter turn about X takes -Z to -Y, Y to -Z and leaves X. Sizes are of no account.
TEST(GltfProfiles, LampsTurnWithTheirNodes) {
  const Scene scene =
      Lamps::of(uneven())
          .add(
              R"({"light": 0})",
              R"("rotation": [-0.70710678, 0, 0, 0.70710678], "scale": [3, 2, 7], "translation": [1, 1, 5], )")
          .read();
  expectNear(scene.lights[0].position, Vec3(0, 0, 5));
  EXPECT_NEAR(candelaTo(scene, Vec3(0, -1, 0)), 40, 1e-4f);
  EXPECT_NEAR(candelaTo(scene, Vec3(0, 0, -1)), 9, 1e-4f);
  EXPECT_NEAR(candelaTo(scene, Vec3(-1, 0, 0)), 18, 1e-4f);
  EXPECT_NEAR(candelaTo(scene, Vec3(0, 0, 1)), 27, 1e-4f);
}

TEST(GltfProfiles, ANodeThatMirrorsGivesTheMirrorImage) {
  for (const char* scale : {"[1, -1, 1]", "[-1, 1, 1]", "[1, 1, -1]"}) {
    const Scene scene = Lamps::of(uneven())
                            .add(R"({"light": 0})", std::string(R"("scale": )") + scale + ", ")
                            .read();
    const bool x = scale[1] == '-', y = scale[4] == '-', z = !x && !y;
    const auto to = [&](Vec3 w) {
      return candelaTo(scene, w * Vec3(x ? -1 : 1, y ? -1 : 1, z ? -1 : 1));
    };
    EXPECT_NEAR(to(Vec3(0, 0, -1)), 40, 1e-4f) << scale;
    EXPECT_NEAR(to(Vec3(0, 1, 0)), 9, 1e-4f) << scale;
    EXPECT_NEAR(to(Vec3(-1, 0, 0)), 18, 1e-4f) << scale;
    EXPECT_NEAR(to(Vec3(0, -1, 0)), 27, 1e-4f) << scale;
  }
}

TEST(GltfProfiles, MultiplierAndColourScaleThem) {
  const auto intensity = [](const char* use) {
    return Lamps::of(uneven()).add(use).read().lights.at(0).intensity;
  };
  EXPECT_EQ(intensity(R"({"light": 0, "multiplier": 2.5, "color": [1, 0.5, 0]})"),
            Vec3(100, 50, 0));
  EXPECT_EQ(intensity(R"({"light": 0, "color": [3, -1, 0.25]})"), Vec3(40, 0, 10)) << "0 to 1";
  EXPECT_EQ(intensity(R"({"light": 0, "multiplier": 0})"), Vec3(0));
}

TEST(GltfProfiles, LampsShareWhatTheyHaveInCommon) {
  const Scene scene = Lamps::of(uneven())
                          .add(R"({"light": 0})")
                          .add(R"({"light": 0, "multiplier": 2})")
                          .add(R"({"light": 0})", R"("scale": [1, -1, 1], )")
                          .read();
  ASSERT_EQ(scene.profiles.size(), 2u) << "and a mirrored one";
  EXPECT_EQ(scene.lights[0].profile, scene.lights[1].profile);
  EXPECT_NE(scene.lights[0].profile, scene.lights[2].profile);
  EXPECT_EQ(scene.lights[2].intensity, Vec3(40));
}

TEST(GltfProfiles, ComeFromFilesDataUrisAndBufferViews) {
  const std::string ies = uneven().text();
  const TempFolder folder;
  folder.write("lamps/wall washer.ies", ies);
  folder.write("data.bin", triangleBytes());
  const Scene expected = Lamps::of(uneven()).add(R"({"light": 0})").read();
  const auto expectSame = [&](const Scene& scene) {
    ASSERT_EQ(scene.profiles.size(), 1u);
    EXPECT_EQ(scene.profiles[0].values, std::as_const(expected).profiles[0].values);
    EXPECT_EQ(scene.lights.at(0).intensity, expected.lights[0].intensity);
  };
  const Lamps named =
      Lamps(R"({"uri": "lamps/wall%20washer.ies", "name": "washer"})").add(R"({"light": 0})");
  expectSame(readScene(folder.write("binary.glb", triangleGlb(named.json()))));
  expectSame(readScene(folder.write("text.gltf", with(named.json(), R"("byteLength": 48})",
                                                      R"("byteLength": 48, "uri": "data.bin"})"))));
  Bytes bytes = triangleBytes();
  bytes.insert(bytes.end(), ies.begin(), ies.end());
  std::string json = Lamps(R"({"bufferView": 2, "mimeType": "application/x-ies-lm-63"})")
                         .add(R"({"light": 0})")
                         .json();
  json = with(json, R"("byteLength": 12})",
              R"("byteLength": 12}, {"buffer": 0, "byteOffset": 48, "byteLength": )" +
                  std::to_string(ies.size()) + "}");
  json = with(json, R"("byteLength": 48}])",
              R"("byteLength": )" + std::to_string(bytes.size()) + "}]");
  expectSame(readScene(folder.write("view.glb", glb(json, bytes))));
}

TEST(GltfProfiles, SayWhatIsWrongAndWhere) {
  const auto has = [](const Lamps& lamps, const char* part) {
    EXPECT_CONTAINS(errorOf([&] { lamps.read(); }), part);
  };
  const auto ofUri = [](const std::string& uri) {
    return Lamps(R"({"uri": ")" + uri + "\"}").add(R"({"light": 0})");
  };
  IesText typeB = uneven();
  typeB.type = "2";
  has(Lamps::of(typeB).add(R"({"light": 0})"),
      "node 1 'lamp': light profile 'data:application/x-ies-lm-63': line 4: photometry of type B");
  has(ofUri("none.ies"), "light profile 'none.ies': 'none.ies' is missing");
  has(ofUri("../none.ies"), "leads outside the scene's folder");
  has(ofUri("/etc/passwd"), "not a path beneath the scene's folder");
  has(ofUri("http://x.org/a.ies"), "not a path beneath the scene's folder");
  has(ofUri("data:,hello"), "not a photometric file");
  has(Lamps(R"({"extras": 1})").add(R"({"light": 0})"),
      "light profile '0': it has neither 'uri' nor 'bufferView'");
  has(Lamps("3").add(R"({"light": 0})"), "neither 'uri' nor 'bufferView'");
  has(Lamps(R"({"bufferView": 9})").add(R"({"light": 0})"), "buffer view 9 does not exist");
  has(Lamps::of(uneven()).add(R"({"light": 1})"), "light profile 1 does not exist");
  has(Lamps::of(uneven()).add("{}"), "light profile -1 does not exist");
  has(Lamps::of(uneven()).add(R"({"light": 0, "multiplier": -1})"), "'multiplier' is -1");
  has(Lamps::of(uneven()).add(R"({"light": 0, "color": [1]})"), "'color' does not have 3 numbers");
}

std::string logOf(const IesText& file) {
  testing::internal::CaptureStderr();
  Lamps::of(file).add(R"({"light": 0})").read();
  return testing::internal::GetCapturedStderr();
}

// 100 cd all around are 1257 lm.
TEST(GltfProfiles, TheLogTellsTheFluxAndWhetherTheLampsCanMakeIt) {
  IesText file;
  EXPECT_CONTAINS(logOf(file), "1257 lm\n");
  file.lamps = "2", file.lumens = "800";
  const std::string line = logOf(file);
  EXPECT_CONTAINS(line, "1257 lm, 78.5 % of its lamps' 1600 lm");
  EXPECT_EQ(line.find("more than its lamps"), std::string::npos);
  file.lumens = "500";
  EXPECT_CONTAINS(logOf(file), "it sends out more than its lamps make");
  EXPECT_EQ(logOf(file).find("TILT"), std::string::npos);
  file.tilt = "TILT=other.tlt\n";
  EXPECT_CONTAINS(logOf(file), "TILT is left out");
  EXPECT_EQ(logOf(file).find("nothing reads it"), std::string::npos) << "all of it is read";
}

TEST(GltfProfiles, AreSavedAndReadAgain) {
  const Scene scene =
      Lamps::of(uneven())
          .add(R"({"light": 0, "multiplier": 0.3, "color": [1, 0.7, 0.1]})",
               R"("rotation": [0.1, 0.2, 0.3, 0.9273618], "translation": [1, 2, 3], )")
          .add(R"({"light": 0})",
               R"("rotation": [0.70710678, 0, 0, 0.70710678], "scale": [-1, 1, 1], )")
          .read();
  const TempFolder folder;
  writeGltf(folder.path() / "saved.glb", scene);
  const Scene again = readScene(folder.path() / "saved.glb");
  expectSameScene(scene, again);
  ASSERT_EQ(again.profiles.size(), 2u);
  for (size_t i = 0; i < 2; ++i) {
    const LightProfile &one = scene.profiles[i], &other = again.profiles[i];
    EXPECT_EQ(one.values, other.values);
    EXPECT_EQ(one.vertical, other.vertical);
    EXPECT_EQ(one.horizontal, other.horizontal);
    EXPECT_EQ(scene.lights[i].profile, again.lights[i].profile);
    EXPECT_NEAR(glm::length(scene.lights[i].across - again.lights[i].across), 0, 1e-6f);
  }
}

TEST(GltfProfiles, EditsMoveAndTurnThemAndKeepTheProfile) {
  const Scene scene = Lamps::of(uneven()).add(R"({"light": 0})").read();
  SceneEdit edit;
  LightEdit light = editOf(scene, 0);
  light.direction = Vec3(0, -1, 0), light.across = Vec3(0.6f, -0.8f, 0);  // not yet perpendicular
  light.intensity = Vec3(20), light.position = Vec3(0.5f);
  edit.lights = {light};
  checkEdit(scene, edit);
  const Scene after = edited(scene, edit);
  validate(after);
  EXPECT_EQ(after.lights[0].across, Vec3(1, 0, 0));
  EXPECT_EQ(after.lights[0].profile, 0);
  EXPECT_NEAR(candelaTo(after, Vec3(0, -1, 0)), 20, 1e-4f);
  EXPECT_NEAR(candelaTo(after, Vec3(-1, 0, 0)), 9, 1e-4f);
  edit.lights[0].across = Vec3(0, 1, 0);
  EXPECT_CONTAINS(errorOf([&] { checkEdit(scene, edit); }), "along its axis");
}

// A lamp beside an ordinary light on one node: both move. A quarter turn about its own axis turns
// the profile.
TEST(GltfProfiles, AnimationsTurnThem) {
  std::string json = Lamps::of(uneven())
                         .with(R"(, "KHR_lights_punctual": {"lights": [{"type": "point"}]})")
                         .add(R"({"light": 0}, "KHR_lights_punctual": {"light": 0})")
                         .json();
  Bytes bytes = triangleBytes();
  const float s = 0.70710678f;
  append<float>(bytes, {0, 1}), append<float>(bytes, {0, 0, 0, 1, 0, 0, s, s});
  json = with(json, R"("type": "SCALAR"})",
              R"("type": "SCALAR"}, {"bufferView": 2, "componentType": 5126, "count": 2,
              "type": "SCALAR"}, {"bufferView": 3, "componentType": 5126, "count": 2, "type": "VEC4"})");
  json = with(json, R"("byteLength": 12})",
              R"("byteLength": 12}, {"buffer": 0, "byteOffset": 48, "byteLength": 8},
              {"buffer": 0, "byteOffset": 56, "byteLength": 32})");
  json = with(json, R"("byteLength": 48}])",
              R"("byteLength": 88}], "animations": [{"channels": [{"sampler": 0, "target":
              {"node": 1, "path": "rotation"}}], "samplers": [{"input": 2, "output": 3}]}])");
  const TempFolder folder;
  const Scene scene = readScene(folder.write("scene.glb", glb(json, bytes)));
  ASSERT_EQ(scene.lights.size(), 2u);
  EXPECT_EQ(scene.lights[0].kind, LightKind::point);
  const SceneEdit now = animationAt(scene, 1);
  ASSERT_EQ(now.lights.size(), 2u);
  const Scene turned = edited(scene, now);
  const auto to = [&](Vec3 w) { return Emitters::intensity(turned, turned.lights[1], w).x; };
  EXPECT_NEAR(to(Vec3(-1, 0, 0)), 9, 1e-4f);
  EXPECT_NEAR(to(Vec3(0, -1, 0)), 18, 1e-4f);
}

TEST(GltfProfiles, ScenesWithDamagedOnesAreRefused) {
  const Scene good = Lamps::of(uneven()).add(R"({"light": 0})").read();
  const auto refused = [&](auto change, const char* part) {
    Scene scene = good;
    change(scene);
    EXPECT_CONTAINS(errorOf([&] { validate(scene); }), part);
  };
  refused([](Scene& s) { s.lights[0].profile = 1; }, "profile 1 does not exist");
  refused([](Scene& s) { s.lights[0].profile = -1; }, "profile -1 does not exist");
  refused([](Scene& s) { s.lights[0].across = Vec3(0, 0, 1); }, "across its axis");
  refused([](Scene& s) { s.lights[0].across = Vec3(2, 0, 0); }, "across its axis");
  refused([](Scene& s) { s.profiles[0].values[0] = NAN; }, "light profile 0 'data:");
}

}  // namespace
}  // namespace ninefold
