#include "master/options/options.h"

#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "common/scene/replay_line.h"
#include "common/scene/settings_table.h"
#include "tests/scene/simple_scene.h"

namespace ninefold {
namespace {

using Variables = std::map<std::string, std::string>;

// Words as a shell would hand them over; without an output there would be nothing to do.
Options parse(const std::string& line, const Variables& variables = {}, bool output = true) {
  std::vector<std::string> words{"ninefold-master"};
  std::istringstream in(line);
  for (std::string word; in >> word;) words.push_back(word);
  if (output) words.insert(words.end(), {"--output", "out.exr"});
  std::vector<const char*> argv;
  for (const std::string& word : words) argv.push_back(word.c_str());
  const auto variable = [&](const std::string& name) {
    const auto found = variables.find(name);
    return found == variables.end() ? std::nullopt : std::optional(found->second);
  };
  return parseOptions(static_cast<int>(argv.size()), argv.data(), variable, 6);
}

// The one line that a wrong command line ends in; "" if it was right.
std::string complaint(const std::string& line, const Variables& variables = {},
                      bool output = true) {
  try {
    parse(line, variables, output);
    return "";
  } catch (const UsageError& error) {
    return error.what();
  }
}

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

// Range, default and what presets make of it come from where they are used.
TEST(Options, HelpTellsRangesAndDefaults) {
  std::istringstream words(helpText());  // however its lines are broken
  std::string help;
  for (std::string word; words >> word;) help += word + " ";
  for (const char* text : {
           "pixels, each 1 to 16384 (default 640x480)",
           "instant-radiosity (default)",
           "light sets side by side, each 1 to 16 (default 3x3)",
           "per set, 0 to 65536 (default 4; final 16)",
           "mean per set, 0 to 65536 (default 18; final 72)",
           "caustic photons per set, 0 to 16777216 (default 1000; final 10000)",
           "0 = no limit (default 0; paper 4)",
           "in a row at most, 1 to 1024 (default 32)",
           "b = C/R^2, above 0 (default 30; paper 300)",
           "0 = none (default 4; paper 0)",
           "as a fraction of R, up to 1 (default 0.02)",
           "from lit surfaces too (default all; paper direct)",
           "pseudo-random points (default owen; paper xor)",
           "of all randomness (default 1)",
       })
    EXPECT_NE(help.find(text), std::string::npos) << text << " in " << help;
  EXPECT_NE(help.find(describeMethods()), std::string::npos) << help;
}

TEST(Options, PatienceIsTwoMinutesUnlessItIsStated) {
  EXPECT_EQ(parse("room.glb").patience, 120);
  EXPECT_EQ(parse("room.glb --patience 2.5").patience, 2.5);
  EXPECT_NE(complaint("room.glb --patience -1").find("--patience"), std::string::npos);
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
  EXPECT_NE(complaint("room.glb --filter-at clients --interleave 5x4").find("--interleave"),
            std::string::npos);
  EXPECT_NE(complaint("room.glb --filter-at clients --aovs").find("--aovs"), std::string::npos);
  EXPECT_TRUE(parse("room.glb --filter-at clients --window --view normal").filterAtClients);
  EXPECT_TRUE(parse("room.glb --filter-at clients --view direct").filterAtClients);
  EXPECT_NE(complaint("room.glb --filter-at clients --view normal").find("--filter-at master"),
            std::string::npos);
  EXPECT_EQ(parse("room.glb --wire-level auto").wireLevel, Delivery::kAdaptive);
  EXPECT_NE(complaint("room.glb --wire-level 20"), "");
}

TEST(Options, TheExposureIsTheScenesOrGivenOrThePictures) {
  EXPECT_EQ(parse("room.glb").exposure, std::nullopt);
  EXPECT_TRUE(parse("room.glb --exposure auto").autoExposure);
  EXPECT_EQ(parse("room.glb --exposure 0").exposure, 0.0f);
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
  EXPECT_NE(complaint("room.glb", {{"NINEFOLD_AOVS", "yes"}}).find("NINEFOLD_AOVS"),
            std::string::npos);
  EXPECT_NE(complaint("room.glb", {{"NINEFOLD_SIZE", "huge"}}), "");
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

TEST(Options, WhatIsOutOfRangeIsRefusedWithOneLineThatNamesTheFlag) {
  const std::pair<const char*, const char*> cases[] = {
      {"--size", "0x480"},
      {"--size", "16385x1"},
      {"--size", "640"},
      {"--interleave", "17x1"},
      {"--interleave", "0x3"},
      {"--direct-vpls", "65537"},
      {"--direct-vpls", "-1"},
      {"--indirect-vpls", "x"},
      {"--photons", "16777217"},
      {"--path-length", "1.5"},
      {"--specular-depth", "0"},
      {"--bound", "0"},
      {"--bound", "nan"},
      {"--photon-radius", "2"},
      {"--vpl-roulette", "-1"},
      {"--caustics", "some"},
      {"--environment", "1,2"},
      {"--environment", "-1"},
      {"--environment", "blue"},
      {"--frames", "0"},
      {"--seconds", "0"},
      {"--until-error", "0"},
      {"--until-error", "2"},
      {"--exposure", "1000"},
      {"--exposure", "automatic"},
      {"--seed", "-1"},
      {"--isa", "sse"},
      {"--local-clients", "-1"},
      {"--client-threads", "0"},
      {"--wait-clients", "0"},
      {"--listen", "4700"},
      {"--listen", "0.0.0.0:99999"},
      {"--preset", "fast"},
      {"--method", "voodoo"},
      {"--filter", "blur"},
      {"--randomization", "dice"},
  };
  for (const auto& [flag, value] : cases) {
    const std::string line = complaint(std::string("room.glb ") + flag + " " + value);
    EXPECT_NE(line.find(flag), std::string::npos) << flag << " " << value << ": " << line;
    EXPECT_NE(line.find(value), std::string::npos) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  }
}

TEST(Options, WrongUsageIsRefused) {
  EXPECT_NE(complaint("").find("no scene"), std::string::npos);
  EXPECT_NE(complaint("a.glb b.glb").find("more than one scene"), std::string::npos);
  EXPECT_NE(complaint("a.glb --colour 3").find("colour"), std::string::npos);
  EXPECT_NE(complaint("a.glb -x").find("-x is no option"), std::string::npos);
  EXPECT_NE(complaint("-x").find("-x is no option"), std::string::npos);
  EXPECT_NE(complaint("a.glb --size 3x3 --size 4x4").find("size"), std::string::npos);
  EXPECT_NE(complaint("a.glb --siz 3x3").find("siz"), std::string::npos) << "no guessing";
  EXPECT_NE(complaint("a.glb --seed").find("seed"), std::string::npos);
}

TEST(Options, AFileForThePictureOrTheStatsIsNeeded) {
  EXPECT_NE(complaint("a.glb", {}, false).find("--output"), std::string::npos);
  EXPECT_EQ(complaint("a.glb --stats s.json", {}, false), "");
  EXPECT_NE(complaint("a.glb --output a.jpg", {}, false).find(".exr"), std::string::npos);
  EXPECT_NE(complaint("a.glb --aovs --output a.png", {}, false).find("--aovs"), std::string::npos);
}

TEST(Options, ListeningBeyondThisMachineNeedsAKey) {
  EXPECT_NE(complaint("a.glb --listen 0.0.0.0:4700").find("--key-file"), std::string::npos);
  EXPECT_EQ(complaint("a.glb --listen [::1]:4700"), "");
  EXPECT_EQ(complaint("a.glb --listen localhost:0"), "");
}

TEST(Options, AnAnimationNeedsARangeAndNumberedPictures) {
  const Options o = parse("a.glb --animate 0.5:2:25 --frames 8 --output p.##.exr", {}, false);
  ASSERT_TRUE(o.animate);
  EXPECT_EQ(std::tuple(o.animate->from, o.animate->to, o.animate->rate), std::tuple(0.5, 2, 25));
  EXPECT_EQ(o.stop.frames, 8);
  EXPECT_TRUE(parse("a.glb --window --animate 0:2:25", {}, false).animate);
  for (const char* bad : {"0", "0:1", "0,1,25", "0:1:25:3", "1:0:25", "-1:1:25", "0:1:0",
                          "0:1:2000", "0:inf:25", "0:x:25", "0:1:nan"})
    EXPECT_NE(complaint(std::string("a.glb --output p.##.exr --animate ") + bad, {}, false)
                  .find("--animate " + std::string(bad)),
              std::string::npos)
        << bad;
  EXPECT_NE(complaint("a.glb --animate 0:1:25 --output p.exr", {}, false).find("####"),
            std::string::npos);
  EXPECT_NE(complaint("a.glb --animate 0:1:25 --seconds 3").find("--frames"), std::string::npos);
  EXPECT_NE(complaint("a.glb --animate 0:1:25 --script s.json").find("--script"),
            std::string::npos);
  EXPECT_NE(complaint("a.glb --animate 0:1:25 --filter-at clients"), "");
}

TEST(Options, AWindowNeedsNoOutput) {
  EXPECT_TRUE(parse("a.glb --window", {}, false).window);
  EXPECT_TRUE(parse("a.glb", {{"NINEFOLD_WINDOW", "1"}}, false).window);
  EXPECT_FALSE(parse("a.glb", {{"NINEFOLD_WINDOW", "0"}}).window);
  EXPECT_NE(complaint("a.glb --window --headless"), "");
  EXPECT_EQ(parse("a.glb --window --frame-time 50", {}, false).frameTime, 50);
}

TEST(Options, AScriptMayWritePicturesOrTimes) {
  EXPECT_EQ(parse("a.glb --script s.json --stats t.json", {}, false).script, "s.json");
  EXPECT_EQ(parse("a.glb --script s.json --output p.####.png", {}, false).script, "s.json");
  EXPECT_NE(complaint("a.glb --script s.json", {}, false), "");
}

TEST(Options, EveryViewHasItsName) {
  for (const char* name : kViewNames)
    EXPECT_EQ(nameOf(parse(std::string("a.glb --window --view ") + name).view), std::string(name));
  EXPECT_NE(complaint("a.glb --view clients"), "");
  EXPECT_NE(complaint("a.glb --view upside-down").find("albedo, normal"), std::string::npos);
}

TEST(Options, HelpAndNewKeyNeedNothingElse) {
  EXPECT_TRUE(parse("--help", {}, false).help);
  EXPECT_EQ(parse("--new-key cluster.key", {}, false).newKey, "cluster.key");
}

TEST(Options, HelpNamesEveryFlagOfTheInterface) {
  const std::string help = helpText();
  for (const char* flag :
       {"size",           "camera",      "local-clients", "client-threads", "listen",
        "key-file",       "new-key",     "wait-clients",  "method",         "preset",
        "interleave",     "direct-vpls", "indirect-vpls", "photons",        "path-length",
        "specular-depth", "bound",       "photon-radius", "caustics",       "environment",
        "frames",         "seconds",     "until-error",   "animate",        "output",
        "aovs",           "exposure",    "view",          "window",         "headless",
        "seed",           "isa",         "stats",         "randomization",  "filter",
        "vpl-roulette",   "denoise",     "script",        "frame-time",     "help"})
    EXPECT_NE(help.find("--" + std::string(flag) + " "), std::string::npos) << flag;
  std::istringstream lines(help);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100u) << line;
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
  EXPECT_NE(complaint("a.glb --animate 0:1:5 --denoise on --output a.####.exr", {}, false)
                .find("--denoise"),
            std::string::npos);
  EXPECT_NE(complaint("a.glb --denoise much").find("--denoise"), std::string::npos);
  EXPECT_NE(complaint("a.glb --method path-trace --denoise on --output a.png", {}, false)
                .find("--method path-trace gives no guides"),
            std::string::npos);
  EXPECT_NE(complaint("a.glb --filter-at clients --denoise on").find("--denoise"),
            std::string::npos);
}

TEST(Options, ShortHelpIsHelpAndANegativeNumberIsAValue) {
  EXPECT_TRUE(parse("-h", {}, false).help);
  EXPECT_TRUE(parse("--version", {}, false).version);
  EXPECT_EQ(parse("a.glb --exposure -5").exposure, std::optional<float>(-5.0f));
  for (const char* status : {"0 done", "1 a failure", "2 wrong usage", "143 SIGTERM", "129 SIGHUP"})
    EXPECT_NE(helpText().find(status), std::string::npos) << status;
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
  EXPECT_THROW(makeSettings(parse("a.glb --camera attic"), scene), Error);
}

}  // namespace
}  // namespace ninefold
