#include "master/output/metrics.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace ninefold {
namespace {

struct Row {
  const char* labels;  // with braces, or empty
  double value;
};

void add(std::string& text, const char* name, const char* type, const char* help,
         const std::vector<Row>& rows) {
  text += fmt::format("# HELP ninefold_{0} {1}\n# TYPE ninefold_{0} {2}\n", name, help, type);
  for (const Row& row : rows)
    text += std::isfinite(row.value)
                ? fmt::format("ninefold_{}{} {}\n", name, row.labels, row.value)
                : fmt::format("ninefold_{}{} NaN\n", name, row.labels);
}

double count(uint64_t n) { return static_cast<double>(n); }

double inState(const RunMetrics& run, ClientState state, bool isStuck = false) {
  return static_cast<double>(std::ranges::count_if(run.clients, [&](const ClientInfo& client) {
    return client.status.state == state && client.isStuck() == isStuck;
  }));
}

}  // namespace

std::string metricsText(const RunMetrics& run) {
  const ServerTally& tally = run.tally;
  const SchedulerCounts& tasks = tally.tasks;
  std::string text;
  add(text, "frames_total", "counter", "Frames that are complete.",
      {{"", count(tasks.completedFrames)}});
  add(text, "picture_frames", "gauge", "Frames that the picture at rest is the mean of.",
      {{"", static_cast<double>(run.framesInPicture)}});
  add(text, "relative_error", "gauge", "Relative standard error of the picture at rest.",
      {{"", run.relativeError}});
  add(text, "rays_total", "counter", "Rays of accepted results.",
      {{"{kind=\"eye\"}", count(tally.rays.eye)},
       {"{kind=\"shadow\"}", count(tally.rays.shadow)},
       {"{kind=\"photon\"}", count(tally.rays.photon)},
       {"{kind=\"compensation\"}", count(tally.rays.compensation)}});
  add(text, "clients", "gauge", "Clients by what they do.",
      {{"{state=\"connecting\"}", inState(run, ClientState::connecting)},
       {"{state=\"syncing\"}", inState(run, ClientState::syncing)},
       {"{state=\"building\"}", inState(run, ClientState::building)},
       {"{state=\"ready\"}", inState(run, ClientState::ready)},
       {"{state=\"stuck\"}", inState(run, ClientState::ready, true)}});
  add(text, "received_bytes_total", "counter", "Bytes from clients.",
      {{"", count(tally.bytesReceived)}});
  add(text, "tasks_total", "counter", "Results that were accepted.", {{"", count(tasks.accepted)}});
  add(text, "tasks_reissued_total", "counter",
      "Tasks taken back from lost, suspect or stuck clients.", {{"", count(tasks.reissued)}});
  add(text, "results_refused_total", "counter", "Results that were not used.",
      {{"{reason=\"stale\"}", count(tasks.droppedStale)},
       {"{reason=\"duplicate\"}", count(tasks.droppedDuplicate)},
       {"{reason=\"unknown\"}", count(tasks.droppedUnknown)},
       {"{reason=\"malformed\"}", count(tally.malformed)}});
  add(text, "values_replaced_total", "counter", "Values that were no light and became 0.",
      {{"", count(tally.replaced)}});
  add(text, "viewers", "gauge", "Browsers that look on.", {{"", count(run.viewers)}});
  add(text, "viewers_refused_total", "counter", "Browsers and others that were turned away.",
      {{"", count(run.viewersRefused)}});
  add(text, "viewer_bytes_total", "counter", "Bytes of pictures and files to browsers.",
      {{"", count(run.bytesToViewers)}});
  return text;
}

}  // namespace ninefold
