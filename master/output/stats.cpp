#include "master/output/stats.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "common/base/standard_streams.h"
#include "common/base/written_file.h"
#include "common/scene/settings_table.h"

namespace ninefold {
namespace {

using Json = nlohmann::ordered_json;

double rate(double amount, double seconds) { return seconds > 0 ? amount / seconds : 0; }

// The smallest value that at least the fraction p of all does not exceed.
double percentile(std::vector<double> values, double p) {
  if (values.empty()) return 0;
  std::ranges::sort(values);
  const auto rank = static_cast<size_t>(std::ceil(p * static_cast<double>(values.size())));
  return values[std::max<size_t>(rank, 1) - 1];
}

Json percentiles(const std::vector<double>& values) {
  return {{"p50", percentile(values, 0.5)},
          {"p95", percentile(values, 0.95)},
          {"max", percentile(values, 1)}};
}

Json numberOrNull(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json list(Vec3 v) { return Json::array({v.x, v.y, v.z}); }

Json object(const Needs& n) {
  return {{"reflection", n.reflection},
          {"transmission", n.transmission},
          {"rough_specular", n.roughSpecular},
          {"smooth_specular", n.smoothSpecular},
          {"textures", n.textures},
          {"alpha_mask", n.alphaMask},
          {"area_lights", n.areaLights},
          {"punctual_lights", n.punctualLights},
          {"environment", n.environment}};
}

Json object(const Camera& c) {
  return {{"name", c.name},
          {"eye", list(c.eye)},
          {"forward", list(c.forward)},
          {"up", list(c.up)},
          {"vertical_fov", c.verticalFov},
          {"orthographic_height", c.orthographicHeight}};
}

const char* nameOf(SurfaceTest t) {
  return t == SurfaceTest::surface ? "surface" : t == SurfaceTest::paper ? "paper" : "none";
}

template <typename T>
Json jsonOf(const T& value) {
  if constexpr (std::is_enum_v<T>)
    return textOf(value);
  else
    return value;
}
Json jsonOf(Interleave value) { return Json::array({value.n, value.m}); }
Json jsonOf(Radiance value) { return list(value); }
Json jsonOf(const Camera& value) { return object(value); }

Json settingsOf(const RunStats& s) {
  Json all{{"preset", s.preset}};
  forEachSetting([&](const auto& row) {
    std::string key = row.name;
    std::ranges::replace(key, '-', '_');
    all[key] = jsonOf(s.settings.*row.member);
  });
  all["filter"] = nameOf(s.surfaceTest);
  all["denoise"] = s.denoise ? "on" : "off";
  return all;
}

Json object(const std::vector<ClientStats>& clients) {
  Json all = Json::array();
  for (const ClientStats& c : clients)
    all.push_back({{"name", c.name},
                   {"isa", c.isa},
                   {"tasks", c.tasks},
                   {"busy_fraction", c.busyFraction},
                   {"sets_per_frame", c.setsPerFrame},
                   {"stuck", c.stuck}});
  return all;
}

Json object(const RayCounts& rays) {
  return {{"eye", rays.eye},
          {"shadow", rays.shadow},
          {"photon", rays.photon},
          {"compensation", rays.compensation}};
}

void addPerformance(const RunStats& s, Json& json) {
  const auto frames = static_cast<double>(s.frames - s.framesBefore);
  const double pixels = frames * s.settings.width * s.settings.height;
  json["frames"] = s.frames;
  if (s.framesBefore > 0) json["frames_before"] = s.framesBefore;
  json["seconds"] = s.seconds;
  json["fps"] = rate(frames, s.seconds);
  json["frame_ms"] = percentiles(s.frameMs);
  json["latency_ms"] = percentiles(s.latencyMs);
  json["rays"] = object(s.rays);
  json["rays_per_second"] = rate(static_cast<double>(s.rays.total()), s.seconds);
  json["pixels_per_second"] = rate(pixels, s.seconds);
  json["bytes_received"] = s.bytesReceived;
  json["bytes_per_pixel"] = rate(static_cast<double>(s.bytesReceived), pixels);
}

void addWork(const RunStats& s, Json& json) {
  json["clients"] = object(s.clients);
  json["master"] = {{"decode_ms", s.decodeMs},          {"filter_ms", s.filterMs},
                    {"idle_fraction", s.idleFraction},  {"cpu_ms", s.cpuMs},
                    {"tail_ms", percentiles(s.tailMs)}, {"memory_mb", s.memoryMb}};
  json["tiles_dropped"] = {
      {"stale", s.tilesStale}, {"duplicate", s.tilesDuplicate}, {"malformed", s.tilesMalformed}};
  json["tasks_reissued"] = s.tasksReissued;
  json["clients_stuck"] = s.clientsStuck;
  json["stalls"] = s.stalls;
  json["values_not_finite"] = s.valuesNotFinite;
}

// Nothing for methods without a state.
void addSteps(const StepStats& s, Json& json) {
  if (s.steps == 0) return;
  json["state"] = {{"steps", s.steps},
                   {"units", s.units},
                   {"step_ms", s.ms},
                   {"bytes_received", s.bytesReceived},
                   {"bytes_sent", s.bytesSent}};
}

void addVerification(const VerifyStats& s, Json& json) {
  json["verify"] = {{"checked", s.counts.checked}, {"wrong", s.counts.wrong},
                    {"alone", s.counts.alone},     {"disputed", s.counts.disputed},
                    {"expelled", s.expelled},      {"frames_again", s.framesAgain}};
}

void addJob(const RunStats& s, Json& json) {
  json["relative_error"] = numberOrNull(s.relativeError);
  json["needs"] = object(s.needs);
  json["method"] = textOf(s.settings.method);
  json["settings"] = settingsOf(s);
  json["seed"] = s.settings.seed;
  json["reproducible"] = s.reproducible;
  json["image_hash"] = s.imageHash;
}

}  // namespace

std::string toJson(const RunStats& stats) {
  Json json;
  addPerformance(stats, json);
  addWork(stats, json);
  addSteps(stats.steps, json);
  if (stats.verify) addVerification(*stats.verify, json);
  addJob(stats, json);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void writeStats(const std::string& path, const std::string& json) {
  if (path == kStandardOutput) return writeOutput(json);
  writeFile(path, json);
}

}  // namespace ninefold
