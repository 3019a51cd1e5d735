// The program ninefold-photon-map as a user meets it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/tools/run.h"

namespace ninefold {
namespace {

using Json = nlohmann::json;

Outcome map(const std::string& arguments) {
  return runTool("ninefold-photon-map", arguments + " 2>/dev/null");
}
Json made(const std::string& arguments) {
  const Outcome run =
      map("--size 32x24 --map-photons 400 --map-photons-per-frame 100 " + arguments);
  EXPECT_EQ(run.status, 0) << arguments;
  return run.status == 0 ? Json::parse(run.output) : Json{};
}

TEST(PhotonMapTool, TimesEachStage) {
  for (const char* scene : {"--box 64", NINEFOLD_SCENES "/cornell.glb"}) {
    const Json stages = made(std::string(scene) + " --repeats 3").at("stages");
    for (const char* stage : {"shoot_ms", "balance_ms", "build_ms", "update_ms", "estimate_ms"})
      EXPECT_GT(stages.at(stage), 0) << scene << " " << stage;
    EXPECT_GE(stages.at("total_ms"), stages.at("estimate_ms"));
  }
}

// In a closed room each of 400 paths meets something, and of path length 2 no more than twice.
TEST(PhotonMapTool, CountsHits) {
  const auto hits = [](const std::string& flags) {
    return made("--box 16 --repeats 1 --map-direct on " + flags).at("stages").at("hits").get<int>();
  };
  EXPECT_EQ(hits("--path-length 1"), 400);
  EXPECT_GT(hits("--path-length 2"), 500);
  EXPECT_LE(hits("--path-length 2"), 800);
  EXPECT_EQ(hits("--path-length 2"), hits("--path-length 2"));
}

// 16 surfaces of two triangles, each cut into four: 128 small ones. No surface shares a vertex with
// another, and each has 3 x 3. All that is seen faces the eye.
TEST(PhotonMapTool, CountsEstimatesAtVertices) {
  const Json stages =
      made("--box 16 --repeats 1 --map-estimate vertices --map-subdivision 1").at("stages");
  const auto count = [&](const char* way) {
    return stages.at("vertices").at(way).at("count").get<int>();
  };
  EXPECT_EQ(count("all"), 3 * 128);
  EXPECT_EQ(count("corners"), 16 * 9);
  EXPECT_LT(count("front"), count("all"));
  EXPECT_LT(count("both"), count("corners"));
  EXPECT_LE(count("asked"), count("both"));
  EXPECT_GT(count("asked"), 30);
  for (const char* way : {"all", "front", "corners", "both", "asked"})
    EXPECT_GT(stages.at("vertices").at(way).at("ms"), 0) << way;
  EXPECT_TRUE(made("--box 16 --repeats 1").at("stages").at("vertices").is_null());
}

// The photons of a room of 16 surfaces, whatever is seen.
TEST(PhotonMapTool, PhotonsMayMeetASimplerRoom) {
  const auto hits = [](const std::string& flags) {
    return made("--repeats 1 " + flags).at("stages").at("hits").get<int>();
  };
  EXPECT_EQ(hits("--box 1024 --photon-box 16"), hits("--box 16"));
  EXPECT_EQ(map("--photon-box 16 " NINEFOLD_SCENES "/cornell.glb").status, 2);
}

// While the lamp stands, all distributions but the random one bring the same photons again.
TEST(PhotonMapTool, TellsHowMuchAPictureFluctuates) {
  const auto variance = [](const std::string& flags) {
    const Json motion = made("--box 16 --repeats 0 --light still --frames 6 --truth 4000 " + flags);
    return motion.at("motion").at("variance").get<double>();
  };
  EXPECT_GT(variance("--map-distribution random"), 0);
  for (const char* name : {"frame", "turn", "nets"})
    EXPECT_EQ(variance(std::string("--map-distribution ") + name), 0) << name;
}

// Each of the four units brings a quarter of the change.
TEST(PhotonMapTool, TellsHowLateAPictureIs) {
  const Json motion =
      made("--box 16 --repeats 0 --light jump --map-direct on --runs 2").at("motion");
  EXPECT_EQ(motion.at("lag_theory"), 4);
  const auto response = motion.at("response").get<std::vector<double>>();
  ASSERT_EQ(response.size(), 5u);
  EXPECT_EQ(response.front(), 0);
  EXPECT_EQ(response.back(), 1);
  EXPECT_NEAR(response[2], 0.5, 0.25);
}

TEST(PhotonMapTool, RefusesInOneLine) {
  EXPECT_EQ(map("--box 17").status, 2);
  EXPECT_EQ(map("--box 16 --light sometimes").status, 2);
  EXPECT_EQ(map("--box 16 --method path-trace").status, 2);
  EXPECT_EQ(map("--box 16 --map-photons-per-frame 3000").status, 2);
  EXPECT_EQ(map(NINEFOLD_SCENES "/cornell.glb --light circle").status, 2);
  EXPECT_EQ(map("nowhere.glb").status, 1);
}

TEST(PhotonMapTool, ExplainsItself) {
  EXPECT_EQ(map("--help").status, 0);
  EXPECT_NE(map("--help").output.find("Exit status"), std::string::npos);
}

}  // namespace
}  // namespace ninefold
