// The program ninefold-virtual-lights as a user meets it.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "tests/tools/run.h"

namespace ninefold {
namespace {

const std::string kScene = NINEFOLD_SCENES "/keyhole.glb";

Outcome lights(const std::string& arguments) {
  return runTool("ninefold-virtual-lights", arguments + " 2>/dev/null");
}

// How many there are of each family.
std::map<std::string, int> families(const std::string& flags) {
  const Outcome run = lights(kScene + " --size 32x24 --frames 4 " + flags);
  EXPECT_EQ(run.status, 0);
  std::map<std::string, int> count;
  const auto made = nlohmann::json::parse(run.output);
  for (const auto& light : made.at("lights")) {
    ++count[light.at("family").get<std::string>()];
    EXPECT_EQ(light.at("position").size(), 3u);
  }
  return count;
}

// Rooms of the keyhole: the lamp is where x > 0, the camera where x < 0.
TEST(VirtualLights, TellWhoFoundThem) {
  auto standard = families("--method instant-radiosity");
  EXPECT_EQ(standard["reverse"], 0);
  EXPECT_EQ(standard["lamp"], 4 * 9 * 4);
  EXPECT_GT(standard["standard"], 0);
  auto both = families("--method bidirectional");
  EXPECT_GT(4 * both["reverse"], both["standard"]) << "light comes to the view through a hole";
}

TEST(VirtualLights, CountSetsAndRays) {
  const auto made =
      nlohmann::json::parse(lights(kScene + " --preset segovia --frames 2 --size 32x24").output);
  EXPECT_EQ(made.at("frames"), 2);
  EXPECT_EQ(made.at("sets"), 2);
  EXPECT_GT(made.at("rays"), 1000);
  EXPECT_GT(made.at("seconds"), 0);
  EXPECT_LE(made.at("lights").size(), 62u) << "30 a set, up to rounding";
}

TEST(VirtualLights, AreNotThoseOfAMethodWithout) {
  EXPECT_EQ(lights(kScene + " --method path-trace").status, 2);
  EXPECT_EQ(lights(kScene + " --window").status, 2);
  EXPECT_EQ(lights("nowhere.glb").status, 1);
}

TEST(VirtualLights, ExplainThemselves) {
  EXPECT_EQ(lights("--help").status, 0);
  EXPECT_NE(lights("--help").output.find("Exit status"), std::string::npos);
}

}  // namespace
}  // namespace ninefold
