#include "master/options/options.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <limits>

#include "common/base/written_file.h"
#include "common/scene/camera_choice.h"
#include "common/scene/settings_check.h"
#include "common/scene/settings_table.h"
#include "master/options/numbered_name.h"
#include "master/options/options_flags.h"
#include "master/options/settings_flags.h"
#include "proto/connection.h"
#include "proto/tile_codec.h"

namespace ninefold {
namespace {

constexpr uint64_t kMaxClients = 4096;
constexpr uint64_t kMaxFrames = 1'000'000'000;
constexpr double kMaxSeconds = 1e9;

template <typename T, typename Value>
void assign(T& to, const std::optional<Value>& value) {
  if (value) to = static_cast<T>(*value);
}

void applyPreset(Options& o) {
  o.settings = settingsOf(o.preset);
  if (o.preset != Preset::paper) return;
  o.surfaceTest = SurfaceTest::paper;
  o.converging = false;
}

// Light from outside.
void readOutside(const RawOptions& raw, Options& o) {
  const auto environment = raw.text("environment"), sky = raw.text("sky");
  if (environment && sky) failUsage("--environment and --sky exclude each other");
  if (sky) o.reading.environment = parseSky(*sky);
  if (!environment) return;
  if (namesPicture(*environment))
    o.reading.environment = parseEnvironmentFile(*environment);
  else
    o.environment = o.settings.environment, o.reading.hasColorOutside = true;
}

void readPicture(const RawOptions& raw, Options& o) {
  if (const auto size = raw.text("size"))
    std::tie(o.settings.width, o.settings.height) = parseSize(*size);
  readSettings(raw, o.settings);
  readOutside(raw, o);
  try {
    checkTogether(o.settings);
  } catch (const Error& error) {
    throw UsageError(error.what());
  }
  o.camera = raw.text("camera").value_or("");
  assign(o.reading.lightUnits, raw.choice("light-units", kLightUnitsNames));
  assign(o.surfaceTest, raw.choice("filter", std::array{"none", "paper", "surface"}));
  o.autoExposure = raw.text("exposure") == "auto";
  if (!o.autoExposure)
    if (const auto ev = raw.real("exposure", -double{kMostExposure}, double{kMostExposure}))
      o.exposure = static_cast<float>(*ev);
  assign(o.toneCurve, raw.choice("tone-map", kToneCurveNames));
  o.aovs = raw.isOn("aovs");
  if (const auto touch = raw.choice("denoise", std::array{"off", "on"})) o.denoise = *touch == 1;
  if (o.denoise == true && factsOf(o.settings.method).isUnfiltered)
    failUsage("--denoise on: --method {} gives no guides to filter by; leave --denoise out",
              factsOf(o.settings.method).name);
}

Endpoint parseAddress(const std::string& text, const char* flag) {
  try {
    return parseEndpoint(text, flag);
  } catch (const Error& error) {
    throw UsageError(error.what());
  }
}

void readCluster(const RawOptions& raw, int cores, Options& o) {
  o.localClients = std::max(1, cores);
  assign(o.localClients, raw.whole("local-clients", 0, kMaxClients));
  assign(o.clientThreads, raw.whole("client-threads", 1, 1024));
  assign(o.waitClients, raw.whole("wait-clients", 1, kMaxClients));
  assign(o.verify, raw.real("verify", 0, 1));
  assign(o.patience, raw.real("patience", 0, kMaxSeconds));
  o.keyFile = raw.text("key-file");
  o.addressFile = raw.text("address-file");
  o.announce = raw.isOn("announce");
  o.hosts = raw.text("hosts");
  constexpr std::array kIsas{"auto", "avx2", "avx512"};
  if (const auto isa = raw.choice("isa", kIsas)) o.isa = kIsas[*isa];
  o.listen = raw.text("listen").value_or(o.listen);
  const bool isHere = isLoopback(parseAddress(o.listen, "--listen").host);
  if (isHere && o.hosts)
    failUsage(
        "--hosts {} needs --listen ADDR:PORT where they reach this machine, for example "
        "0.0.0.0:4700",
        *o.hosts);
  if (isHere && o.announce)
    failUsage(
        "--announce needs --listen ADDR:PORT where others reach this machine, for example "
        "0.0.0.0:4700");
  if (!isHere && !o.keyFile)
    failUsage(
        "--listen {} reaches beyond this machine and needs --key-file FILE; make one with "
        "ninefold-master --new-key FILE",
        o.listen);
}

// After the picture: its interleaving and extra layers matter.
void readDelivery(const RawOptions& raw, Options& o) {
  if (const auto at = raw.choice("filter-at", std::array{"master", "clients"}))
    o.filterAtClients = *at == 1;
  const auto level = raw.text("wire-level");
  if (level && *level != "auto")
    o.wireLevel =
        static_cast<int>(parseWhole("wire-level", *level, 0, uint64_t{Delivery::kHighestLevel}));
  if (!o.filterAtClients) return;
  if (o.aovs) failUsage("--aovs needs --filter-at master: clients send finished tiles only");
  if (o.denoise == true)
    failUsage("--denoise on needs --filter-at master: clients send no guides to filter by");
  const int pixels = kTaskSide * kTaskSide * o.settings.interleave.sets();
  if (pixels > kMaxTilePixels)
    failUsage("--filter-at clients: --interleave {}x{} makes tiles of {} pixels, at most are {}",
              o.settings.interleave.n, o.settings.interleave.m, pixels, kMaxTilePixels);
}

void readRun(const RawOptions& raw, Options& o) {
  o.stop.frames = raw.whole("frames", 1, kMaxFrames);
  o.stop.seconds = raw.real("seconds", 1e-3, kMaxSeconds);
  o.stop.untilError = raw.real("until-error", 1e-9, 1);
  if (!o.stop.frames && !o.stop.seconds && !o.stop.untilError) o.stop.frames = kDefaultFrames;
}

void readAnimation(const RawOptions& raw, Options& o) {
  const auto text = raw.text("animate");
  if (!text) return;
  const std::vector<double> n = parseNumbers("animate", *text, ':');
  const bool good = n.size() == 3 && n[0] >= 0 && n[1] >= n[0] && n[1] <= kLongestScript &&
                    n[2] >= kSlowestRate && n[2] <= kFastestRate;
  if (!good)
    failUsage("--animate {}: write T0:T1:FPS, times 0 <= T0 <= T1 <= {} [s], FPS {} to {}", *text,
              kLongestScript, kSlowestRate, kFastestRate);
  o.animate = {n[0], n[1], n[2]};
  if (o.script) failUsage("--animate and --script exclude each other: a script may say animation");
  if (o.stop.seconds || o.stop.untilError)
    failUsage("--animate goes with --frames N, the frames of each picture, and no other stop");
}

// For browsers. Whether there must be a token and TLS follows from the address (web/web_setup.h).
void readServe(const RawOptions& raw, Options& o) {
  o.serve = raw.text("serve");
  o.serveCertificate = raw.text("serve-certificate");
  o.serveKey = raw.text("serve-key");
  if (o.serveCertificate.has_value() != o.serveKey.has_value())
    failUsage("--serve-certificate and --serve-key go together: give both, or none");
  if (!o.serve && o.serveKey) failUsage("--serve-certificate is for --serve ADDR:PORT");
  if (!o.serve) return;
  if (o.window) failUsage("--serve and --window exclude each other");
  parseAddress(*o.serve, "--serve");
}

// In a window, in browsers, or live without either.
void readLive(const RawOptions& raw, Options& o) {
  o.window = raw.isOn("window");
  o.script = raw.text("script");
  o.reading.clip = raw.text("clip");
  o.photonScene = raw.text("photon-scene");
  readAnimation(raw, o);
  if (o.photonScene && !isLive(o) && !factsOf(o.settings.method).has(kMapPhotons))
    failUsage("--photon-scene is for --method {}", factsOf(Method::photonMap).name);
  assign(o.frameTime, raw.real("frame-time", 1, 10000));
  o.stepTime = raw.real("step-time", 1, 10000);
  if (o.window && raw.isOn("headless")) failUsage("--window and --headless exclude each other");
  readServe(raw, o);
  if (isWatched(o)) o.framesAtRest = raw.whole("frames", 1, kMaxFrames);
  if (const auto view = raw.text("view")) {
    const auto known = viewNamed(*view);
    if (!known) failUsage("--view {}: must be {}", *view, fmt::join(kViewNames, ", "));
    o.view = *known;
    if (o.view == PictureView::clients && !isWatched(o))
      failUsage(
          "--view clients is for --window and --serve: who rendered what changes from frame to "
          "frame");
    if (o.filterAtClients && !isLive(o) && !isLight(o.view))
      failUsage("--view {} needs --filter-at master: it is made of what clients traced", *view);
  }
}

// Kinds of files that --output may name.
void checkOutput(const Options& o) {
  const auto ends = [&](const char* extension) { return o.output->ends_with(extension); };
  if (!ends(".exr") && !ends(".hdr") && !isToned(*o.output))
    failUsage("--output {}: the name must end in .exr, .png, .hdr or .mp4", *o.output);
  if (isVideo(*o.output) && (isWatched(o) || !(o.animate || o.script)))
    failUsage("--output {}: a film needs --animate, or a --script with a rate, and no --window",
              *o.output);
  if (o.aovs && !ends(".exr")) failUsage("--aovs needs an --output that ends in .exr");
  if (o.denoise == true && isLive(o) && !isWatched(o) && !isToned(*o.output))
    failUsage("--denoise on, with --script or --animate, needs an --output of .png or .mp4");
}

// Motion blur.
void readShutter(const RawOptions& raw, Options& o) {
  assign(o.shutter, raw.real("shutter", 0, 1));
  if (o.shutter == 0) return;
  if (isWatched(o) || !(o.animate || o.script))
    failUsage("--shutter needs --animate, or a --script with a rate, and no --window or --serve");
  if (o.animate && *o.stop.frames < 2)
    failUsage("--shutter: blur is the mean of a picture's frames; give --frames 16, say");
}

// Named, and there as a file or not there yet: no standard output, device or pipe.
bool isFile(const std::optional<std::string>& name) {
  namespace fs = std::filesystem;
  if (!name || name->empty() || *name == "-") return false;
  std::error_code none;
  const fs::file_status status = fs::status(*name, none);
  return !fs::exists(status) || fs::is_regular_file(status);
}

// What is written must not be what else is written or read.
void checkDifferent(const Options& o) {
  using File = std::pair<const char*, std::optional<std::string>>;
  const std::vector<File> written = {{"--output", o.output},
                                     {"--stats", o.stats},
                                     {"--checkpoint", o.checkpoint},
                                     {"--metrics", o.metrics},
                                     {"--address-file", o.addressFile}};
  std::vector<File> all = {{"the scene", o.scene},     {"--photon-scene", o.photonScene},
                           {"--script", o.script},     {"--key-file", o.keyFile},
                           {"--hosts", o.hosts},       {"--serve-certificate", o.serveCertificate},
                           {"--serve-key", o.serveKey}};
  if (const auto* outside = std::get_if<EnvironmentFile>(&o.reading.environment))
    all.emplace_back("--environment", outside->path);
  std::erase_if(all, [](const File& file) { return !isFile(file.second); });
  for (const auto& [flag, name] : written) {
    if (!isFile(name)) continue;
    for (const auto& [other, otherName] : all)
      if (targetOf(*otherName) == targetOf(*name))
        failUsage("{} and {} name the same file, {}: give two names", other, flag, *name);
    all.emplace_back(flag, name);
  }
}

void readFiles(const RawOptions& raw, Options& o) {
  o.output = raw.text("output");
  o.stats = raw.text("stats");
  o.metrics = raw.text("metrics");
  if (!o.output && !o.stats && !isWatched(o))
    failUsage("nothing to do with the picture: give --output FILE (.exr, .png, .hdr or .mp4)");
  if (o.animate && !isWatched(o) && !namesSeries(o))
    failUsage(
        "--animate needs --output out.####.png (.exr, .hdr), where the # become a number, or "
        "out.mp4");
  o.saveEvery = raw.real("save-every", 1e-3, kMaxSeconds);
  o.checkpoint = raw.text("checkpoint");
  if (isLive(o) && (o.saveEvery || o.checkpoint))
    failUsage(
        "--{} is for one picture at rest: leave --window, --serve, --script and --animate out",
        o.checkpoint ? "checkpoint" : "save-every");
  if (isLive(o) && o.metrics)
    failUsage("--metrics is for one picture at rest; --serve gives them at /metrics");
  if (isLive(o) && o.verify > 0)
    failUsage("--verify is for one picture at rest: leave --window, --script and --animate out");
  if (o.saveEvery && !o.output && !o.checkpoint)
    failUsage("--save-every needs --output FILE or --checkpoint FILE");
  if (o.output) checkOutput(o);
  checkDifferent(o);
}

}  // namespace

Options parseOptions(int argc, const char* const* argv, const Variable& variable, int cores) {
  const RawOptions raw(argc, argv, variable);
  Options o;
  o.help = raw.isOn("help");
  o.newKey = raw.text("new-key");
  o.version = raw.isOn("version");
  if (o.help || o.version || o.newKey) return o;

  o.scene = raw.text("scene").value_or("");
  if (o.scene.empty()) failUsage("no scene is given; see ninefold-master --help");
  assign(o.preset, raw.choice("preset", kPresetNames));
  applyPreset(o);
  readPicture(raw, o);
  readCluster(raw, cores, o);
  readDelivery(raw, o);
  readRun(raw, o);
  readLive(raw, o);
  readShutter(raw, o);
  readFiles(raw, o);
  return o;
}

bool namesSeries(const Options& o) {
  return o.output && (isNumbered(*o.output) || isVideo(*o.output));
}

Settings makeSettings(const Options& options, const Scene& scene) {
  Settings settings = options.settings;
  settings.camera = chooseCamera(scene, options.camera);
  settings.environment = options.environment.value_or(scene.environment);
  checkWith(scene, settings);
  return settings;
}

}  // namespace ninefold
