// What a command line is read as.
#include <gtest/gtest.h>

#include "common/scene/replay_line.h"
#include "common/scene/settings_table.h"
#include "tests/master/command_line.h"
#include "tests/scene/simple_scene.h"

namespace ninefold {
namespace {

using testing::parse;
using testing::Variables;

// The command that clients name when a task goes wrong asks for the settings that the task had.
TEST(Options, AReplayLineGivesTheSettingsThatItWasMadeOf) {
  Scene scene = simpleScene();
  scene.origin = {100, 0, -50};
  Settings s;
  s.width = 123, s.height = 45, s.interleave = {2, 4}, s.seed = 1ull << 63;
  s.camera.eye = Vec3(1, 2, 3.5f), s.camera.forward = glm::normalize(Vec3(1, -0.5f, 0.25f));
  s.directVpls = 5, s.indirectVpls = 99, s.photons = 12345, s.pathLength = 3, s.specularDepth = 7;
  s.bound = 12.345f, s.vplRoulette = 1.25f, s.photonRadius = 0.0123f;
  s.caustics = Caustics::direct, s.randomization = Randomization::exclusiveOr;
  s.environment = Vec3(0.1f, 0.25f, 1e-3f);
  const FrameKey frame{6, 7, 8, 0.25f};
  const std::string program = "ninefold-replay-task SCENE --frame 6:7:8:0.25 --tile 3 --phase 2 ";
  const auto parseLine = [&](const std::string& line) {
    EXPECT_TRUE(line.starts_with(program)) << line;
    return parse(line.substr(program.size()) + " SCENE");
  };
  const Options o = parseLine(replayLine(scene, s, frame, 3, 2));
  EXPECT_EQ(o.scene, "SCENE");
  Settings again = makeSettings(o, scene);
  EXPECT_LT(glm::length(again.camera.eye - s.camera.eye), 1e-5f);
  EXPECT_LT(glm::length(again.camera.forward - s.camera.forward), 1e-5f);
  EXPECT_NEAR(again.camera.verticalFov, s.camera.verticalFov, 1e-5f);
  again.camera = s.camera;
  EXPECT_EQ(again, s);

  // What a method has no use for is not named.
  for (const MethodFacts& facts : allMethods()) {
    s.method = facts.method;
    const std::string words = replayLine(scene, s, frame, 3, 2);
    const Settings same = makeSettings(parseLine(words), scene);
    forEachSetting([&](const auto& row) {
      const bool isNamed = words.find(fmt::format("--{} ", row.name)) != std::string::npos;
      if (row.value == nullptr) return;
      EXPECT_EQ(isNamed, row.isUsedBy(facts.method)) << facts.name << ": " << words;
      if (!isNamed) return;
      EXPECT_EQ(same.*row.member, s.*row.member) << facts.name << ": " << words;
    });
  }

  s.camera = scene.cameras[0];
  s.method = Method::instantRadiosity, s.compensate = s.jitter = false;
  EXPECT_EQ(makeSettings(parseLine(replayLine(scene, s, frame, 3, 2)), scene), s)
      << "to the bit, with a camera of the scene's; without compensation by the paper's preset";
}

TEST(Options, PatienceIsTwoMinutesUnlessItIsStated) {
  EXPECT_EQ(parse("room.glb").verify, 0);
  EXPECT_EQ(parse("room.glb --verify 0.05").verify, 0.05);
  EXPECT_FALSE(parse("room.glb").saveEvery.has_value());
  EXPECT_EQ(parse("room.glb --save-every 2.5").saveEvery, 2.5);
  EXPECT_EQ(parse("room.glb --checkpoint c").checkpoint, "c");
  EXPECT_EQ(parse("room.glb").patience, 120);
  EXPECT_EQ(parse("room.glb --patience 2.5").patience, 2.5);
}

TEST(Options, DefaultsAreTheDocumentedOnes) {
  const Options o = parse("room.glb");
  EXPECT_EQ(o.scene, "room.glb");
  EXPECT_EQ(o.settings.width, 640);
  EXPECT_EQ(o.settings.height, 480);
  EXPECT_EQ(o.settings.interleave, (Interleave{3, 3}));
  EXPECT_EQ(o.settings.directVpls, 4);
  EXPECT_EQ(o.settings.indirectVpls, 18);
  EXPECT_EQ(o.settings.photons, 1000);
  EXPECT_EQ(o.settings.pathLength, 0);
  EXPECT_EQ(o.settings.specularDepth, 32);
  EXPECT_EQ(o.settings.caustics, Caustics::all);
  EXPECT_EQ(o.settings.seed, 1u);
  EXPECT_EQ(o.settings.randomization, Randomization::owen);
  EXPECT_EQ(o.surfaceTest, SurfaceTest::surface);
  EXPECT_EQ(o.localClients, 6);
  EXPECT_EQ(o.clientThreads, 1);
  EXPECT_EQ(o.listen, "127.0.0.1:0");
  EXPECT_EQ(o.waitClients, 1);
  EXPECT_EQ(o.stop.frames, kDefaultFrames);
  EXPECT_FALSE(o.stop.seconds || o.stop.untilError || o.stats || o.keyFile || o.environment ||
               o.aovs);
}

TEST(Options, EveryFlagIsRead) {
  const Options o = parse(
      "--size 320x200 --camera 0,1,5:0,1,0:50 --local-clients 0 --client-threads 3 --listen "
      "0.0.0.0:4700 --key-file k --wait-clients 2 --method instant-radiosity --preset final "
      "--interleave 2x4 --direct-vpls 5 --indirect-vpls 6 --photons 7 --path-length 8 "
      "--specular-depth 9 --bound 10.5 --photon-radius 0.25 --vpl-roulette 0.5 --caustics off "
      "--environment 1,2,3.5 "
      "--frames 11 --seconds 1.5 --until-error 0.01 --aovs --exposure -1.5 --view beauty "
      "--headless --filter none --randomization random --seed 18446744073709551615 --isa avx2 "
      "--wire-level 3 --stats s.json room.glb");
  EXPECT_EQ(o.wireLevel, 3);
  EXPECT_EQ(o.scene, "room.glb");
  EXPECT_EQ(o.settings.width, 320);
  EXPECT_EQ(o.settings.height, 200);
  EXPECT_EQ(o.camera, "0,1,5:0,1,0:50");
  EXPECT_EQ(o.localClients, 0);
  EXPECT_EQ(o.clientThreads, 3);
  EXPECT_EQ(o.listen, "0.0.0.0:4700");
  EXPECT_EQ(o.keyFile, "k");
  EXPECT_EQ(o.waitClients, 2);
  EXPECT_EQ(o.preset, Preset::final);
  EXPECT_EQ(o.settings.interleave, (Interleave{2, 4}));
  EXPECT_EQ(o.settings.directVpls, 5);
  EXPECT_EQ(o.settings.indirectVpls, 6);
  EXPECT_EQ(o.settings.photons, 7);
  EXPECT_EQ(o.settings.pathLength, 8);
  EXPECT_EQ(o.settings.specularDepth, 9);
  EXPECT_FLOAT_EQ(o.settings.bound, 10.5f);
  EXPECT_FLOAT_EQ(o.settings.photonRadius, 0.25f);
  EXPECT_FLOAT_EQ(o.settings.vplRoulette, 0.5f);
  EXPECT_EQ(o.settings.caustics, Caustics::off);
  EXPECT_EQ(*o.environment, Radiance(1, 2, 3.5f));
  EXPECT_EQ(o.stop.frames, 11);
  EXPECT_EQ(o.stop.seconds, 1.5);
  EXPECT_EQ(o.stop.untilError, 0.01);
  EXPECT_TRUE(o.aovs);
  EXPECT_EQ(o.exposure, -1.5f);
  EXPECT_FALSE(o.autoExposure);
  EXPECT_EQ(o.surfaceTest, SurfaceTest::none);
  EXPECT_EQ(o.settings.randomization, Randomization::random);
  EXPECT_EQ(o.settings.seed, UINT64_MAX);
  EXPECT_EQ(o.isa, "avx2");
  EXPECT_EQ(o.stats, "s.json");
  EXPECT_EQ(o.output, "out.exr");
}

TEST(Options, ClientsFilterWhatTheyCan) {
  EXPECT_FALSE(parse("room.glb").filterAtClients);
  EXPECT_TRUE(parse("room.glb --filter-at clients --interleave 4x4").filterAtClients);
  EXPECT_TRUE(parse("room.glb --filter-at clients --window --view normal").filterAtClients);
  EXPECT_TRUE(parse("room.glb --filter-at clients --view direct").filterAtClients);
  EXPECT_EQ(parse("room.glb --wire-level auto").wireLevel, Delivery::kAdaptive);
}

TEST(Options, TheExposureIsTheScenesOrGivenOrThePictures) {
  EXPECT_EQ(parse("room.glb").exposure, std::nullopt);
  EXPECT_TRUE(parse("room.glb --exposure auto").autoExposure);
  EXPECT_FALSE(parse("room.glb").autoExposure) << "unless the scene has none";
  EXPECT_EQ(parse("room.glb --exposure 0").exposure, 0.0f);
}

TEST(Options, LightUnitsAndToneMapAreNamed) {
  EXPECT_EQ(parse("a.glb").reading.lightUnits, LightUnits::automatic);
  EXPECT_EQ(parse("a.glb --light-units photometric").reading.lightUnits, LightUnits::photometric);
  EXPECT_EQ(parse("a.glb --light-units radiometric").reading.lightUnits, LightUnits::radiometric);
  EXPECT_EQ(parse("a.glb").toneCurve, ToneCurve::srgb);
  EXPECT_EQ(parse("a.glb --tone-map filmic").toneCurve, ToneCurve::filmic);
  EXPECT_EQ(parse("a.glb --tone-map agx").toneCurve, ToneCurve::agx);
}

TEST(Options, LightFromOutsideIsAColourAPictureOrASky) {
  const Options picture = parse("a.glb --environment b.hdr:90:2");
  EXPECT_FALSE(picture.environment) << "the scene's, with the picture";
  const auto& file = std::get<EnvironmentFile>(picture.reading.environment);
  EXPECT_EQ(file.path, "b.hdr");
  EXPECT_EQ(file.rotation, 90);
  EXPECT_EQ(file.strength, 2);
  const Options sky = parse("a.glb --sky 120:30");
  EXPECT_EQ(std::get<SkyModel>(sky.reading.environment).elevation, 30);
  const Options colour = parse("a.glb --environment 1,2,3");
  EXPECT_TRUE(std::holds_alternative<std::monostate>(colour.reading.environment));
}

// A task under a picture is done again with that picture.
TEST(Options, AReplayLineNamesThePictureOfTheEnvironment) {
  Scene scene = simpleScene();
  EnvironmentPicture sky{"--sky 120:30:3", 2, 1, std::vector<Vec3>(2, Vec3(1)), 0};
  scene.environmentMap = std::make_shared<const EnvironmentMap>(std::move(sky));
  Settings s;
  s.camera = scene.cameras[0], s.environment = Radiance(1);
  const std::string line = replayLine(scene, s, FrameKey{}, 0, 0);
  EXPECT_NE(line.find(" --sky 120:30:3"), std::string::npos) << line;
  EXPECT_EQ(line.find("--environment"), std::string::npos) << line;
}

TEST(Options, EqualSignsWorkToo) {
  EXPECT_EQ(parse("room.glb --size=20x10 --exposure=-2").settings.width, 20);
}

TEST(Options, FlagsWinOverVariablesAndVariablesOverDefaults) {
  const Variables v{{"NINEFOLD_PHOTONS", "5"}, {"NINEFOLD_SEED", "9"}, {"NINEFOLD_AOVS", "1"}};
  const Options o = parse("room.glb --seed 3", v);
  EXPECT_EQ(o.settings.photons, 5);
  EXPECT_EQ(o.settings.seed, 3u);
  EXPECT_TRUE(o.aovs);
}

TEST(Options, PresetsSetDefaultsThatFlagsOverride) {
  const Options paper = parse("room.glb --preset paper --photons 500");
  EXPECT_EQ(paper.settings.randomization, Randomization::exclusiveOr);
  EXPECT_EQ(paper.settings.interleave, (Interleave{3, 3}));
  EXPECT_EQ(paper.settings.pathLength, 4);
  EXPECT_EQ(paper.settings.directVpls + paper.settings.indirectVpls, 22);
  EXPECT_EQ(paper.settings.photons, 500);
  EXPECT_EQ(paper.settings.caustics, Caustics::direct);
  EXPECT_EQ(paper.surfaceTest, SurfaceTest::paper);
  EXPECT_FALSE(paper.converging);
  const Options segovia = parse("room.glb --preset segovia --seed 3");
  EXPECT_EQ(segovia.settings.method, Method::bidirectional);
  EXPECT_EQ(segovia.settings.partition, PartitionRule::equal);
  EXPECT_EQ(segovia.settings.interleave, (Interleave{1, 1}));
  EXPECT_EQ(segovia.settings.directVpls + segovia.settings.indirectVpls, 30);
  EXPECT_EQ(segovia.settings.cameraPoints, 50);
  const Options dmitriev = parse("room.glb --preset dmitriev");
  EXPECT_EQ(dmitriev.settings.method, Method::selective);
  EXPECT_EQ(dmitriev.settings.photonPool, 1152000);
  EXPECT_EQ(dmitriev.settings.elementRule, ElementRule::buckets);
  const Options ren = parse("room.glb --preset ren --field-directions 19");
  EXPECT_EQ(ren.settings.method, Method::intersectionField);
  EXPECT_EQ(ren.settings.fieldDirections, 19);
  EXPECT_EQ(ren.settings.fieldDistances, 127);
  EXPECT_EQ(ren.settings.fieldWeights, FieldWeights::alike);
  const Options mixed = parse("room.glb --preset paper --filter surface --randomization owen");
  EXPECT_EQ(mixed.surfaceTest, SurfaceTest::surface);
  EXPECT_EQ(mixed.settings.randomization, Randomization::owen);
  const Options final = parse("--preset final --direct-vpls 2 room.glb");
  EXPECT_EQ(final.settings.directVpls, 2);
  EXPECT_GT(final.settings.indirectVpls, 18);
}

TEST(Options, OneStopIsEnough) {
  EXPECT_FALSE(parse("room.glb --seconds 3").stop.frames);
  EXPECT_FALSE(parse("room.glb --until-error 0.02").stop.frames);
}

TEST(Options, AnAnimationHasARangeAndARate) {
  const Options o = parse("a.glb --animate 0.5:2:25 --frames 8 --output p.##.exr", {}, false);
  ASSERT_TRUE(o.animate);
  EXPECT_EQ(std::tuple(o.animate->from, o.animate->to, o.animate->rate), std::tuple(0.5, 2, 25));
  EXPECT_EQ(o.stop.frames, 8);
  EXPECT_TRUE(parse("a.glb --window --animate 0:2:25", {}, false).animate);
}

TEST(Options, AWindowNeedsNoOutput) {
  EXPECT_TRUE(parse("a.glb --window", {}, false).window);
  EXPECT_TRUE(parse("a.glb", {{"NINEFOLD_WINDOW", "1"}}, false).window);
  EXPECT_FALSE(parse("a.glb", {{"NINEFOLD_WINDOW", "0"}}).window);
  EXPECT_EQ(parse("a.glb --window --frame-time 50", {}, false).frameTime, 50);
}

TEST(Options, BrowsersNeedNoOutputAndAreALiveRun) {
  const Options o = parse("a.glb --serve 127.0.0.1:0", {}, false);
  EXPECT_EQ(o.serve, "127.0.0.1:0");
  EXPECT_TRUE(isLive(o) && isWatched(o));
  EXPECT_TRUE(denoises(o, Method::instantRadiosity));
  EXPECT_TRUE(parse("a.glb --serve 127.0.0.1:0 --animate 0:2:25", {}, false).animate);
  const Options own = parse("a.glb --serve 0.0.0.0:1 --serve-key k --serve-certificate c");
  EXPECT_EQ(own.serveKey, "k");
  EXPECT_EQ(own.serveCertificate, "c");
}

TEST(Options, AScriptMayWritePicturesOrTimes) {
  EXPECT_EQ(parse("a.glb --script s.json --stats t.json", {}, false).script, "s.json");
  EXPECT_EQ(parse("a.glb --script s.json --output p.####.png", {}, false).script, "s.json");
}

TEST(Options, EveryViewHasItsName) {
  for (const char* name : kViewNames)
    EXPECT_EQ(nameOf(parse(std::string("a.glb --window --view ") + name).view), std::string(name));
}

TEST(Options, HelpAndNewKeyNeedNothingElse) {
  EXPECT_TRUE(parse("--help", {}, false).help);
  EXPECT_EQ(parse("--new-key cluster.key", {}, false).newKey, "cluster.key");
}

TEST(Options, PicturesForPeopleAreDenoised) {
  EXPECT_TRUE(denoises(parse("a.glb --output a.png", {}, false), Method::instantRadiosity));
  EXPECT_FALSE(denoises(parse("a.glb --output a.exr", {}, false), Method::instantRadiosity));
  EXPECT_FALSE(denoises(parse("a.glb --output a.hdr", {}, false), Method::instantRadiosity));
  EXPECT_FALSE(
      denoises(parse("a.glb --preset paper --output a.png", {}, false), Method::instantRadiosity));
  EXPECT_FALSE(
      denoises(parse("a.glb --denoise off --output a.png", {}, false), Method::instantRadiosity));
  EXPECT_TRUE(
      denoises(parse("a.glb --denoise on --output a.exr", {}, false), Method::instantRadiosity));
  EXPECT_TRUE(denoises(parse("a.glb --window", {}, false), Method::instantRadiosity));
  EXPECT_FALSE(denoises(parse("a.glb --filter-at clients --output a.png", {}, false),
                        Method::instantRadiosity));
  EXPECT_FALSE(denoises(parse("a.glb --output a.png", {}, false), Method::pathTrace))
      << "without guides";
}

TEST(Options, ShortHelpIsHelpAndANegativeNumberIsAValue) {
  EXPECT_TRUE(parse("-h", {}, false).help);
  EXPECT_TRUE(parse("--version", {}, false).version);
  EXPECT_EQ(parse("a.glb --exposure -5").exposure, std::optional<float>(-5.0f));
}

TEST(Options, SettingsTakeCameraAndLightFromTheScene) {
  Scene scene;
  scene.cameras = {Camera{.name = "door"}, Camera{.name = "desk", .verticalFov = 0.5f}};
  scene.environment = Radiance(0.25f);
  EXPECT_EQ(makeSettings(parse("a.glb --camera desk"), scene).camera, scene.cameras[1]);
  EXPECT_EQ(makeSettings(parse("a.glb"), scene).camera, scene.cameras[0]);
  EXPECT_EQ(makeSettings(parse("a.glb"), scene).environment, Radiance(0.25f));
  EXPECT_EQ(makeSettings(parse("a.glb --environment none"), scene).environment, Radiance(0));
  EXPECT_EQ(makeSettings(parse("a.glb --environment 2"), scene).environment, Radiance(2));
}

// Light that was made for other views is told with them.
TEST(Options, AReplayLineHasTheCamerasThatLightIsMadeFor) {
  const Scene scene = simpleScene();
  Settings s;
  s.camera = scene.cameras[0];
  FrameKey frame{6, 7, 8, 0.25f};
  EXPECT_EQ(replayLine(scene, s, frame, 3, 2).find("--light-cameras"), std::string::npos);
  Camera other;
  other.eye = Vec3(1, 2, 3);
  frame.lightCameras = {s.camera, other};
  const std::string line = replayLine(scene, s, frame, 3, 2);
  EXPECT_NE(line.find(" --light-cameras 0/1,2,3:1,2,2:"), std::string::npos) << line;
}

TEST(Options, AReplayLineNamesWhatPhotonsMeet) {
  Scene scene;
  scene.cameras = {Camera{}};
  const auto isNamed = [&](Method method) {
    Settings s;
    s.method = method;
    return replayLine(scene, s, {}, 3, 2).find(" --photon-scene FILE") != std::string::npos;
  };
  EXPECT_FALSE(isNamed(Method::photonMap));
  scene.photonInstances.emplace_back();
  EXPECT_TRUE(isNamed(Method::photonMap));
  EXPECT_FALSE(isNamed(Method::instantRadiosity));
}

}  // namespace
}  // namespace ninefold
