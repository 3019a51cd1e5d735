#include "master/running/latency_log.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

namespace ninefold {
namespace {

// Nearest rank; 0 of nothing.
double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<size_t>(std::ceil(q * static_cast<double>(values.size())));
  return values[std::clamp<size_t>(rank, 1, values.size()) - 1];
}

const char* nameOf(Delivery::Form form) {
  constexpr std::array kNames{"layers", "radiance", "codes"};
  return kNames[static_cast<size_t>(form)];
}

nlohmann::ordered_json summary(const std::vector<double>& values) {
  return {{"count", values.size()},
          {"p50", quantile(values, 0.5)},
          {"p95", quantile(values, 0.95)},
          {"max", quantile(values, 1)}};
}

}  // namespace

void LatencyLog::add(const Shown& shown) {
  const LiveFrame& frame = shown.frame;
  entries_.push_back({frame.order.key.frame, frame.order.key.state,
                      seconds(shown.completed - start_),
                      frame.moving ? seconds(shown.completed - frame.changed) : -1,
                      seconds(shown.completed - frame.opened), frame.moving,
                      frame.order.delivery.form, shown.image->width, shown.image->height,
                      MotionQuality::kLights[static_cast<size_t>(frame.quality.light)]});
  steps_.insert(steps_.end(), shown.steps.begin(), shown.steps.end());
}

void LatencyLog::add(const std::vector<Shot>& shots) {
  shots_.insert(shots_.end(), shots.begin(), shots.end());
}

std::string LatencyLog::json(const std::string& scene, const ServerTally& tally) const {
  std::vector<double> latency, moving;
  nlohmann::ordered_json frames = nlohmann::ordered_json::array();
  for (const Entry& e : entries_) {
    if (e.moving) latency.push_back(1e3 * e.latency), moving.push_back(1e3 * e.took);
    nlohmann::ordered_json frame{
        {"frame", e.frame}, {"time", e.time},     {"moving", e.moving}, {"form", nameOf(e.form)},
        {"width", e.width}, {"height", e.height}, {"light", e.light},   {"took_ms", 1e3 * e.took}};
    if (e.state != 0) frame["state"] = e.state;
    if (e.moving) frame["latency_ms"] = 1e3 * e.latency;
    frames.push_back(std::move(frame));
  }
  nlohmann::ordered_json all{{"scene", scene},
                             {"latency_ms", summary(latency)},
                             {"moving_frame_ms", summary(moving)},
                             {"clients_stuck", tally.tasks.clientsStuck},
                             {"values_not_finite", tally.replaced},
                             {"frames", std::move(frames)}};
  for (const LiveStep& s : steps_)
    all["steps"].push_back({{"step", s.key.number},
                            {"from", s.key.from},
                            {"to", s.key.to},
                            {"first_unit", s.key.firstUnit},
                            {"units", s.key.units},
                            {"randomization", s.key.randomization},
                            {"moving", s.moving},
                            {"time", seconds(s.done - start_)},
                            {"took_ms", 1e3 * seconds(s.done - s.opened)}});
  for (const Shot& s : shots_)
    all["shots"].push_back({{"shot", s.number},
                            {"frame", s.frame},
                            {"opened", s.opened},
                            {"shown", s.shown},
                            {"frames", s.frames},
                            {"lost", s.isLost}});
  return all.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace ninefold
