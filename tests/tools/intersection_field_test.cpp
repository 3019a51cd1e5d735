// The program ninefold-intersection-field as a user meets it.
#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/tools/run.h"

namespace ninefold {
namespace {

using Json = nlohmann::json;

class IntersectionFieldTool : public testing::Test {
 protected:
  void SetUp() override {
    edit_ = std::filesystem::temp_directory_path() /
            ("ninefold_field_edit_" + std::to_string(getpid()) + ".json");
    std::ofstream(edit_) << R"({"seconds": 1, "events": [
      {"from": 0, "to": 1, "object": "glass sphere", "by": [0.2, 0, 0.1]}]})";
  }
  void TearDown() override { std::filesystem::remove(edit_); }

  Outcome tool(const std::string& arguments) const {
    return runTool("ninefold-intersection-field", NINEFOLD_SCENES "/table_room.glb " + arguments);
  }

  std::filesystem::path edit_;
};

TEST_F(IntersectionFieldTool, TellsSizesAndTimes) {
  const Outcome run = tool("--edit " + edit_.string() +
                           " --field-directions 7 --field-distances 12 --field-photons 1024 "
                           "2>/dev/null");
  ASSERT_EQ(run.status, 0) << run.output;
  const Json all = Json::parse(run.output);
  EXPECT_EQ(all.at("lines"), 4 * 7 * 12 * 7 * 12);
  EXPECT_GT(all.at("hits"), all.at("lines").get<int>() / 2);
  EXPECT_LE(all.at("runs"), all.at("hits"));
  EXPECT_GE(all.at("field_bytes"), 16 * all.at("runs").get<int>());
  for (const char* part : {"field_seconds", "element_seconds", "node_seconds", "lamp_seconds"}) {
    EXPECT_GT(all.at(part), 0) << part;
    EXPECT_GT(all.at("edit").at(part), 0) << part;
  }
  EXPECT_GT(all.at("photon_seconds"), 0);
}

TEST_F(IntersectionFieldTool, SaysWhatItCannotUse) {
  const auto refused = [&](int status, const std::string& arguments, const std::string& text) {
    const Outcome run = tool(arguments);
    EXPECT_EQ(run.status, status) << arguments;
    EXPECT_NE(run.output.find(text), std::string::npos) << run.output;
  };
  refused(2, "--method photon-map", "needs --method intersection-field");
  refused(2, "--field-directions 12 --field-distances 32", "have the divisor 4 in common");
  refused(1, "--field-directions 76 --field-distances 127 --max-field-memory 1",
          "--max-field-memory is 1: raise it, or use --field-directions");
}

}  // namespace
}  // namespace ninefold
