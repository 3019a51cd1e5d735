// The program ninefold-compare as a user meets it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "common/base/release.h"
#include "common/image/image_file.h"
#include "tests/tools/run.h"

namespace ninefold {
namespace {

Outcome compare(const std::string& arguments) { return runTool("ninefold-compare", arguments); }

// Two grey images of 10 x 10 pixels, 1.1 and 1, and one of 10 x 11.
class Compare : public testing::Test {
 protected:
  Compare() {
    std::filesystem::create_directories(folder_);
    write("image.exr", 10, 1.1f);
    write("reference.exr", 10, 1);
    write("larger.exr", 11, 1);
  }
  ~Compare() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

 private:
  void write(const std::string& name, int height, float value) const {
    RgbImage image;
    image.reset(10, height);
    for (auto* plane : {&image.pixels.r, &image.pixels.g, &image.pixels.b})
      std::fill(plane->begin(), plane->end(), value);
    writeImage(path(name), {image, {}, {}});
  }
  std::filesystem::path folder_ = std::filesystem::temp_directory_path() /
                                  ("ninefold_compare_" + std::to_string(getpid()) +
                                   testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(Compare, WritesAllFiguresAsJson) {
  const Outcome run = compare(path("image.exr") + " " + path("reference.exr") + " --json");
  ASSERT_EQ(run.status, 0) << run.output;
  const auto json = nlohmann::json::parse(run.output);
  EXPECT_NEAR(json.at("rmse"), 0.1, 1e-6);
  EXPECT_NEAR(json.at("rmse_percent"), 10, 1e-4);
  EXPECT_NEAR(json.at("relmse"), 0.01 / 1.01, 1e-6);
  EXPECT_NEAR(json.at("relmse_trimmed"), 0.01 / 1.01, 1e-6);
  ASSERT_EQ(json.at("bias").size(), 3u);
  EXPECT_NEAR(json.at("bias")[2], 0.1, 1e-6);
  EXPECT_LT(json.at("ssim"), 1);
  EXPECT_TRUE(json.at("worst_pixel").contains("x"));
  EXPECT_EQ(json.at("non_finite").at("image"), 0);
}

TEST_F(Compare, WritesATableForPeople) {
  const Outcome run = compare(path("image.exr") + " " + path("reference.exr"));
  EXPECT_EQ(run.status, 0);
  EXPECT_NE(run.output.find("rmse_percent    10\n"), std::string::npos) << run.output;
}

TEST_F(Compare, AnswersWrongUsageWithTwo) {
  for (const std::string& arguments :
       {std::string(), path("image.exr"), path("a") + " b c", path("a") + " b --unknown"}) {
    const Outcome run = compare(arguments);
    EXPECT_EQ(run.status, 2) << arguments;
    EXPECT_EQ(std::count(run.output.begin(), run.output.end(), '\n'), 1) << run.output;
  }
}

TEST_F(Compare, AnswersBadImagesWithOneAndOneLine) {
  for (const std::string& other : {path("larger.exr"), path("none.exr")}) {
    const Outcome run = compare(path("image.exr") + " " + other);
    EXPECT_EQ(run.status, 1);
    EXPECT_EQ(std::count(run.output.begin(), run.output.end(), '\n'), 1) << run.output;
  }
}

TEST_F(Compare, FiguresThatDoNotArriveAreAFailure) {
  for (const char* lost : {" 2>&1 >/dev/full", " 2>&1 >&-"}) {
    const Outcome run = compare(path("image.exr") + " " + path("reference.exr") + lost);
    EXPECT_EQ(run.status, 1);
    EXPECT_EQ(std::count(run.output.begin(), run.output.end(), '\n'), 1) << run.output;
  }
}

TEST_F(Compare, ExplainsItself) {
  const Outcome run = compare("--help");
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(compare("-h").output, run.output);
  EXPECT_EQ(compare("--version").output, "ninefold-compare " + releaseName() + "\n");
  for (const char* word : {"Usage:", "--json", "Exit status: 0", "relmse_trimmed", "worst_pixel"})
    EXPECT_NE(run.output.find(word), std::string::npos) << word;
}

}  // namespace
}  // namespace ninefold
