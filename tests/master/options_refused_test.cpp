// Which command lines are refused, and in what words.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/master/command_line.h"

namespace ninefold {
namespace {

using testing::complaint;
using testing::parse;

TEST(OptionsRefused, WhatIsOutOfRangeIsRefusedWithOneLineThatNamesTheFlag) {
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
      {"--environment", "a.hdr:x"},
      {"--environment", "a.exr:0:-1"},
      {"--sky", "120"},
      {"--sky", "120:95"},
      {"--light-units", "candela"},
      {"--tone-map", "aces"},
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
      {"--serve", "8080"},
      {"--serve", "127.0.0.1:x"},
      {"--preset", "fast"},
      {"--method", "voodoo"},
      {"--filter", "blur"},
      {"--randomization", "dice"},
      {"--map-estimate", "corners"},
      {"--map-subdivision", "7"},
  };
  for (const auto& [flag, value] : cases) {
    const std::string line = complaint(std::string("room.glb ") + flag + " " + value);
    EXPECT_NE(line.find(flag), std::string::npos) << flag << " " << value << ": " << line;
    EXPECT_NE(line.find(value), std::string::npos) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  }
}

TEST(OptionsRefused, WrongUsageIsRefused) {
  EXPECT_NE(complaint("").find("no scene"), std::string::npos);
  EXPECT_NE(complaint("a.glb b.glb").find("more than one scene"), std::string::npos);
  EXPECT_NE(complaint("a.glb --colour 3").find("colour"), std::string::npos);
  EXPECT_NE(complaint("a.glb -x").find("-x is no option"), std::string::npos);
  EXPECT_NE(complaint("-x").find("-x is no option"), std::string::npos);
  EXPECT_NE(complaint("a.glb --size 3x3 --size 4x4").find("size"), std::string::npos);
  EXPECT_NE(complaint("a.glb --siz 3x3").find("siz"), std::string::npos) << "no guessing";
  EXPECT_NE(complaint("a.glb --seed").find("seed"), std::string::npos);
}

TEST(OptionsRefused, HostsMustReachThisMachine) {
  EXPECT_NE(complaint("a.glb --hosts h").find("--listen"), std::string::npos);
  EXPECT_NE(complaint("a.glb --hosts h --listen 0.0.0.0:4700").find("--key-file"),
            std::string::npos);
  EXPECT_EQ(complaint("a.glb --hosts h --listen 0.0.0.0:4700 --key-file k"), "");
}

TEST(OptionsRefused, AnnouncedIsWhatOthersReach) {
  EXPECT_NE(complaint("a.glb --announce").find("--listen"), std::string::npos);
  EXPECT_EQ(complaint("a.glb --announce --listen 0.0.0.0:4700 --key-file k"), "");
}

TEST(OptionsRefused, AFileForThePictureOrTheStatsIsNeeded) {
  EXPECT_NE(complaint("a.glb", {}, false).find("--output"), std::string::npos);
  EXPECT_EQ(complaint("a.glb --stats s.json", {}, false), "");
  EXPECT_NE(complaint("a.glb --output a.jpg", {}, false).find(".exr"), std::string::npos);
  EXPECT_NE(complaint("a.glb --aovs --output a.png", {}, false).find("--aovs"), std::string::npos);
}

TEST(OptionsRefused, ListeningBeyondThisMachineNeedsAKey) {
  EXPECT_NE(complaint("a.glb --listen 0.0.0.0:4700").find("--key-file"), std::string::npos);
  EXPECT_EQ(complaint("a.glb --listen [::1]:4700"), "");
  EXPECT_EQ(complaint("a.glb --listen localhost:0"), "");
}

TEST(OptionsRefused, PatienceIsNotNegative) {
  EXPECT_NE(complaint("room.glb --verify 1.5").find("--verify"), std::string::npos);
  EXPECT_NE(complaint("room.glb --save-every 0").find("--save-every"), std::string::npos);
  for (const char* flag : {"--verify 0.5", "--save-every 1", "--checkpoint c"})
    for (const char* live : {"--window", "--script s.json", "--animate 0:1:1 --output o.#.exr"})
      EXPECT_NE(complaint(fmt::format("room.glb {} {}", flag, live), {}, false), "")
          << flag << live;
  EXPECT_NE(complaint("room.glb --patience -1").find("--patience"), std::string::npos);
}

TEST(OptionsRefused, ClientsFilterNoWidePatternsLayersOrPaintedViews) {
  EXPECT_NE(complaint("room.glb --filter-at clients --interleave 5x4").find("--interleave"),
            std::string::npos);
  EXPECT_NE(complaint("room.glb --filter-at clients --aovs").find("--aovs"), std::string::npos);
  EXPECT_NE(complaint("room.glb --filter-at clients --view normal").find("--filter-at master"),
            std::string::npos);
}

TEST(OptionsRefused, OnlyAMapsPhotonsMeetASimplerScene) {
  EXPECT_NE(complaint("a.glb --photon-scene b.glb").find("--photon-scene is for --method"),
            std::string::npos);
  EXPECT_EQ(complaint("a.glb --photon-scene b.glb --method photon-map"), "");
  EXPECT_EQ(complaint("a.glb --photon-scene b.glb --window"), "");
}

TEST(OptionsRefused, AWireLevelHasABound) { EXPECT_NE(complaint("room.glb --wire-level 20"), ""); }

TEST(OptionsRefused, AVariableIsHeldToTheRangeOfItsFlag) {
  EXPECT_NE(complaint("room.glb", {{"NINEFOLD_AOVS", "yes"}}).find("NINEFOLD_AOVS"),
            std::string::npos);
  EXPECT_NE(complaint("room.glb", {{"NINEFOLD_SIZE", "huge"}}), "");
}

TEST(OptionsRefused, AnAnimationNeedsARangeAndNumberedPictures) {
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

TEST(OptionsRefused, AFilmAndBlurAreOfAnimations) {
  EXPECT_EQ(complaint("a.glb --animate 0:1:25 --output a.mp4 --shutter 0.5", {}, false), "");
  EXPECT_EQ(complaint("a.glb --script s.json --output a.mp4 --shutter 1", {}, false), "");
  EXPECT_NE(complaint("a.glb --output a.mp4", {}, false).find("a film needs"), std::string::npos);
  EXPECT_NE(complaint("a.glb --window --output a.mp4", {}, false).find("a film needs"),
            std::string::npos);
  for (const char* bad : {"-0.1", "1.1", "nan", "half"})
    EXPECT_NE(complaint(fmt::format("a.glb --script s.json --shutter {}", bad)).find("--shutter"),
              std::string::npos)
        << bad;
  EXPECT_NE(complaint("a.glb --shutter 0.5").find("--shutter needs"), std::string::npos);
  EXPECT_NE(complaint("a.glb --window --script s.json --shutter 0.5").find("--shutter needs"),
            std::string::npos);
  EXPECT_NE(complaint("a.glb --animate 0:1:25 --output a.mp4 --frames 1 --shutter 1", {}, false)
                .find("--frames"),
            std::string::npos);
}

TEST(OptionsRefused, AWindowIsNotHeadless) {
  EXPECT_NE(complaint("a.glb --window --headless"), "");
  EXPECT_NE(complaint("a.glb --window --serve 127.0.0.1:0"), "");
  EXPECT_NE(complaint("a.glb --serve 127.0.0.1:0 --serve-key k"), "");
  EXPECT_NE(complaint("a.glb --serve-key k --serve-certificate c"), "");
}

TEST(OptionsRefused, AScriptThatWritesNothingIsRefused) {
  EXPECT_NE(complaint("a.glb --script s.json", {}, false), "");
}

TEST(OptionsRefused, AViewThatIsNotThereIsRefusedWithThoseThatAre) {
  EXPECT_NE(complaint("a.glb --view clients"), "");
  EXPECT_NE(complaint("a.glb --view upside-down").find("albedo, normal"), std::string::npos);
}

TEST(OptionsRefused, NothingIsDenoisedWithoutGuides) {
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

TEST(OptionsRefused, ACameraMustBeTheScenes) {
  Scene scene;
  scene.cameras = {Camera{.name = "door"}};
  EXPECT_THROW(makeSettings(parse("a.glb --camera attic"), scene), Error);
}

TEST(Options, WhatIsWrittenIsNothingElse) {
  EXPECT_EQ(complaint("room.glb --checkpoint ./out.exr"),
            "--output and --checkpoint name the same file, ./out.exr: give two names");
  EXPECT_EQ(complaint("room.glb --stats room.glb"),
            "the scene and --stats name the same file, room.glb: give two names");
  EXPECT_EQ(complaint("room.glb --checkpoint a --stats a"),
            "--stats and --checkpoint name the same file, a: give two names");
  EXPECT_EQ(complaint("room.glb --key-file k --address-file k"),
            "--key-file and --address-file name the same file, k: give two names");
  EXPECT_EQ(complaint("room.glb --environment out.exr:90"),
            "--environment and --output name the same file, out.exr: give two names");
  EXPECT_EQ(complaint("room.glb --stats /dev/null --address-file /dev/null"), "");
  EXPECT_EQ(complaint("room.glb --checkpoint a --stats b --address-file c --metrics d"), "");
}

}  // namespace
}  // namespace ninefold
