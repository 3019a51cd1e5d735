#include "master/output/stats.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "common/base/error.h"
#include "common/scene/settings_table.h"

namespace ninefold {
namespace {

using Json = nlohmann::ordered_json;

RunStats example() {
  RunStats s;
  s.frames = 4, s.seconds = 2;
  s.frameMs = {400, 500, 100, 1000};
  s.latencyMs = {800, 900, 1100};
  s.rays = {.eye = 1000, .shadow = 20000, .photon = 300, .compensation = 0};
  s.bytesReceived = 6'144'000;
  s.clients = {
      {.name = "alpha", .isa = "avx2", .tasks = 700, .busyFraction = 0.9, .setsPerFrame = 5}};
  s.decodeMs = 1.5, s.filterMs = 2.5, s.idleFraction = 0.75;
  s.tilesStale = 1, s.tilesDuplicate = 2, s.tilesMalformed = 3, s.tasksReissued = 4;
  s.relativeError = 0.05;
  s.needs.textures = true;
  s.preset = "paper";
  s.settings.seed = std::numeric_limits<uint64_t>::max();
  s.imageHash = "00c0ffee00c0ffee";
  return s;
}

TEST(Stats, HasExactlyTheKeysOfTheInterface) {
  const Json json = Json::parse(toJson(example()));
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  EXPECT_EQ(keys, (std::vector<std::string>{"frames",
                                            "seconds",
                                            "fps",
                                            "frame_ms",
                                            "latency_ms",
                                            "rays",
                                            "rays_per_second",
                                            "pixels_per_second",
                                            "bytes_received",
                                            "bytes_per_pixel",
                                            "clients",
                                            "master",
                                            "tiles_dropped",
                                            "tasks_reissued",
                                            "clients_stuck",
                                            "stalls",
                                            "values_not_finite",
                                            "relative_error",
                                            "needs",
                                            "method",
                                            "settings",
                                            "seed",
                                            "reproducible",
                                            "image_hash"}));
  const auto keysOf = [](const Json& object) {
    std::string all;
    for (const auto& [key, value] : object.items()) all += key + " ";
    return all;
  };
  EXPECT_EQ(keysOf(json["frame_ms"]), "p50 p95 max ");
  EXPECT_EQ(keysOf(json["latency_ms"]), "p50 p95 max ");
  EXPECT_EQ(keysOf(json["rays"]), "eye shadow photon compensation ");
  EXPECT_EQ(keysOf(json["clients"][0]), "name isa tasks busy_fraction sets_per_frame stuck ");
  EXPECT_EQ(keysOf(json["master"]), "decode_ms filter_ms idle_fraction cpu_ms tail_ms memory_mb ");
  EXPECT_EQ(keysOf(json["master"]["tail_ms"]), "p50 p95 max ");
  EXPECT_EQ(keysOf(json["tiles_dropped"]), "stale duplicate malformed ");
}

TEST(Stats, RatesFollowFromCounts) {
  const Json json = Json::parse(toJson(example()));
  EXPECT_DOUBLE_EQ(json["fps"], 2);
  EXPECT_DOUBLE_EQ(json["rays_per_second"], 21300 / 2);
  EXPECT_DOUBLE_EQ(json["pixels_per_second"], 640 * 480 * 4 / 2);
  EXPECT_DOUBLE_EQ(json["bytes_per_pixel"], 5);
  EXPECT_DOUBLE_EQ(json["frame_ms"]["p50"], 400);
  EXPECT_DOUBLE_EQ(json["frame_ms"]["p95"], 1000);
  EXPECT_DOUBLE_EQ(json["frame_ms"]["max"], 1000);
  EXPECT_DOUBLE_EQ(json["latency_ms"]["p50"], 900);
  EXPECT_EQ(json["seed"].get<uint64_t>(), std::numeric_limits<uint64_t>::max());
}

TEST(Stats, SettingsNameRandomizationFilterAndLastTouchAsTheFlagsDo) {
  RunStats s = example();
  s.settings.randomization = Randomization::random;
  s.surfaceTest = SurfaceTest::none;
  Json settings = Json::parse(toJson(s))["settings"];
  EXPECT_EQ(settings["randomization"], "random");
  EXPECT_EQ(settings["filter"], "none");
  EXPECT_EQ(settings["denoise"], "off");
  s.denoise = true;
  settings = Json::parse(toJson(s))["settings"];
  EXPECT_EQ(settings["denoise"], "on");
}

// Their keys are their names, with _ for -.
TEST(Stats, SettingsAreAllThere) {
  const Json settings = Json::parse(toJson(example()))["settings"];
  forEachSetting([&](const auto& row) {
    std::string key = row.name;
    std::ranges::replace(key, '-', '_');
    EXPECT_TRUE(settings.contains(key)) << key;
  });
  EXPECT_EQ(settings["preset"], "paper");
  EXPECT_EQ(settings["method"], "instant-radiosity");
  EXPECT_EQ(settings["interleave"], Json::array({3, 3}));
  EXPECT_EQ(settings["direct_vpls"], 4);
  EXPECT_EQ(settings["caustics"], "all");
  EXPECT_EQ(settings["environment"], Json::array({0, 0, 0}));
  EXPECT_EQ(settings["compensate"], true);
  EXPECT_EQ(settings["camera"]["forward"], Json::array({0, 0, -1}));
}

TEST(Stats, ARunWithoutFramesIsStillValidJson) {
  RunStats empty;
  empty.relativeError = std::numeric_limits<double>::infinity();
  empty.clients = {{.name = "bad \xff name"}};
  const Json json = Json::parse(toJson(empty));
  EXPECT_TRUE(json["relative_error"].is_null());
  EXPECT_EQ(json["fps"], 0);
  EXPECT_EQ(json["bytes_per_pixel"], 0);
}

TEST(Stats, AFileIsWholeOrNotThere) {
  const auto folder = std::filesystem::path(::testing::TempDir()) / "ninefold_stats_test";
  std::filesystem::remove_all(folder);
  const std::string path = folder / "s.json";
  EXPECT_THROW(writeStats(path, toJson(example())), Error);  // no such folder
  std::filesystem::create_directories(folder);
  writeStats(path, toJson(example()));
  writeStats(path, toJson(example()));  // replaces
  EXPECT_EQ(Json::parse(std::ifstream(path))["frames"], 4);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace ninefold
