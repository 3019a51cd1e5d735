// What Prometheus and browsers are told of a run.
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "master/output/metrics.h"
#include "master/web/web_state.h"

namespace ninefold {
namespace {

using nlohmann::json;

RunMetrics someRun() {
  RunMetrics run;
  run.tally.tasks.completedFrames = 12;
  run.tally.tasks.reissued = 3;
  run.tally.tasks.droppedStale = 4;
  run.tally.malformed = 5;
  run.tally.rays.shadow = 123456789012345;
  run.tally.bytesReceived = 987;
  run.relativeError = 0.25;
  run.viewers = 2;
  ClientInfo ready, stuck;
  ready.status.state = stuck.status.state = ClientState::ready;
  stuck.work = ClientReport{};
  stuck.work->stuck = true;
  run.clients = {ready, ready, stuck};
  return run;
}

std::vector<std::string> linesOf(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

bool has(const RunMetrics& run, const std::string& wanted) {
  for (const std::string& line : linesOf(metricsText(run)))
    if (line == wanted) return true;
  return false;
}

TEST(Metrics, CountsWhatTheRunDoes) {
  const RunMetrics run = someRun();
  for (const char* line :
       {"ninefold_frames_total 12", "ninefold_tasks_reissued_total 3",
        "ninefold_results_refused_total{reason=\"stale\"} 4",
        "ninefold_results_refused_total{reason=\"malformed\"} 5",
        "ninefold_rays_total{kind=\"shadow\"} 123456789012345", "ninefold_received_bytes_total 987",
        "ninefold_relative_error 0.25", "ninefold_viewers 2", "ninefold_clients{state=\"ready\"} 2",
        "ninefold_clients{state=\"stuck\"} 1"})
    EXPECT_TRUE(has(run, line)) << line << " in\n" << metricsText(run);
}

TEST(Metrics, AnErrorThatIsNotKnownIsNoNumber) {
  RunMetrics run;
  run.relativeError = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(has(run, "ninefold_relative_error NaN"));
}

// Each sample follows the help and the type of its name; names of counters end in _total.
TEST(Metrics, AreInTheFormatOfPrometheus) {
  std::string name, type;
  for (const std::string& line : linesOf(metricsText(someRun()))) {
    std::istringstream words(line);
    std::string first, second, third;
    words >> first >> second;
    if (first == "#") {
      words >> third;
      EXPECT_TRUE(second == "HELP" || second == "TYPE") << line;
      if (second == "HELP") name = third;
      EXPECT_EQ(third, name) << line;
      if (second == "TYPE") words >> type;
      continue;
    }
    EXPECT_EQ(first.substr(0, first.find('{')), name) << line;
    EXPECT_EQ(type == "counter", name.ends_with("_total")) << line;
    EXPECT_FALSE(second.empty()) << line;
  }
}

TEST(WebState, TellsWhatThePanelShows) {
  Shown shown;
  shown.frames = 7;
  shown.relativeError = 0.125;
  PanelView view;
  view.shown = &shown;
  view.state = "2 ready";
  view.tone.exposure = 1.5f;
  view.view = PictureView::depth;
  view.selection = Selection{3, "a cup", 0, {}};
  view.lights = {"lamp one"};
  view.cameras = {"front", "top"};
  const json state = json::parse(stateText(view, "room", "saved"));
  EXPECT_EQ(state["frames"], 7);
  EXPECT_EQ(state["error"], 0.125);
  EXPECT_EQ(state["moving"], false);
  EXPECT_EQ(state["state"], "2 ready");
  EXPECT_EQ(state["exposure"], 1.5);
  EXPECT_EQ(state["view"], "depth");
  EXPECT_EQ(state["selection"], "a cup");
  EXPECT_EQ(state["lamps"], json::array({"lamp one"}));
  EXPECT_EQ(state["cameras"].size(), 2u);
  EXPECT_EQ(state["scene"], "room");
  EXPECT_EQ(state["notice"], "saved");
  EXPECT_EQ(state["playing"], json());
}

TEST(WebState, AnErrorThatIsNotKnownIsNull) {
  Shown shown;
  shown.relativeError = std::numeric_limits<double>::infinity();
  PanelView view;
  view.shown = &shown;
  EXPECT_EQ(json::parse(stateText(view, "", ""))["error"], json());
}

TEST(WebState, NamesThatAreNoUtf8AreRepaired) {
  PanelView view;
  view.cameras = {"\xff\xfe"};
  EXPECT_NO_THROW(json::parse(stateText(view, "\xc3", "")));
  EXPECT_NO_THROW(json::parse(progressText("\xc3", "\xff")));
}

TEST(WebState, TellsOfSoManyClientsAtMost) {
  PanelView view;
  view.clients.resize(1000);
  EXPECT_EQ(json::parse(stateText(view, "", ""))["clients"].size(), kMostClientsTold);
}

}  // namespace
}  // namespace ninefold
