// The program ninefold-selective-photons as a user meets it.
#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/tools/run.h"

namespace ninefold {
namespace {

using Json = nlohmann::json;

class SelectivePhotonsTool : public testing::Test {
 protected:
  void SetUp() override {
    edit_ = std::filesystem::temp_directory_path() /
            ("ninefold_selective_edit_" + std::to_string(getpid()) + ".json");
    std::ofstream(edit_) << R"({"seconds": 1, "events": [
      {"from": 0, "to": 1, "object": "glass sphere", "by": [0.2, 0, 0.1]},
      {"from": 0, "to": 1, "material": "lamp", "emission": [5, 4, 3]}]})";
  }
  void TearDown() override { std::filesystem::remove(edit_); }

  Outcome tool(const std::string& arguments) const {
    return runTool("ninefold-selective-photons", NINEFOLD_SCENES "/table_room.glb " + arguments);
  }
  Json made(const std::string& arguments) const {
    const Outcome run =
        tool("--edit " + edit_.string() + " --photon-pool 9216 " + arguments + " 2>/dev/null");
    EXPECT_EQ(run.status, 0) << run.output;
    return run.status == 0 ? Json::parse(run.output) : Json{};
  }

  std::filesystem::path edit_;
};

// At the end all is found, and never less than before.
TEST_F(SelectivePhotonsTool, TellsHowSoonWhatAnEditConcernsIsFound) {
  const Json all = made("--units 34");
  EXPECT_GT(all.at("amiss"), 0);
  EXPECT_LE(all.at("amiss"), all.at("hits"));
  EXPECT_GT(all.at("state_bytes"), 12 * all.at("hits").get<int>());
  double found = 0;
  for (const Json& point : all.at("curve")) {
    EXPECT_GE(point.at("found"), found);
    found = point.at("found");
  }
  EXPECT_EQ(found, 1);
  EXPECT_EQ(all.at("curve").back().at("photons"), 9216);
  EXPECT_EQ(all.at("curve").size(), 9u);
}

TEST_F(SelectivePhotonsTool, ShowsPathsOfTwoGroups) {
  const Json paths = made("--units 306 --paths 3,200").at("paths");
  ASSERT_EQ(paths.size(), 2u);
  for (const Json& group : paths) {
    EXPECT_EQ(group.size(), 30u);
    for (const Json& path : group) EXPECT_LE(path.size(), 3u);
  }
}

TEST_F(SelectivePhotonsTool, SaysWhatItCannotUse) {
  const auto refused = [&](const std::string& arguments, const std::string& text) {
    const Outcome run = tool(arguments);
    EXPECT_EQ(run.status, 2) << arguments;
    EXPECT_NE(run.output.find(text), std::string::npos) << run.output;
  };
  const std::string edit = "--edit " + edit_.string() + " ";
  refused("", "--edit is missing");
  refused(edit + "--method photon-map", "needs --method selective-photons");
  refused(edit + "--photon-groups 289", "must be a product of 2, 3, 5 and 7");
  refused(edit + "--photon-pool 5000", "no multiple of photon-groups 288 times pilot-ratio 16");
  refused(edit + "--paths 3", "two groups");
  refused(edit + "--element-size 0", "element-size");
}

}  // namespace
}  // namespace ninefold
