// ninefold-photon-map SCENE | --box N [options]: what the photon map's stages cost, how its
// pictures fluctuate, how wrong they are in motion, and how late: the figures of Jozwowski 2002, 5,
// for one choice of settings, as JSON. One process, one thread.
//
// Exit status: 0 done, 1 a failure, 2 wrong usage.

#include <nlohmann/json.hpp>

#include "common/base/program.h"
#include "common/base/release.h"
#include "common/base/standard_streams.h"
#include "common/image/image_file.h"
#include "common/scene/methods.h"
#include "common/scene/photon_scene.h"
#include "common/scene/settings_table.h"
#include "master/options/options.h"
#include "tools/map_box.h"
#include "tools/map_motion.h"
#include "tools/map_stages.h"
#include "tools/words.h"

namespace ninefold {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kProgram = "ninefold-photon-map";
constexpr const char* kHelp =
    "Usage: ninefold-photon-map SCENE [options]\n"
    "       ninefold-photon-map --box N [options]\n\n"
    "What a frame of the photon map costs stage by stage, and with --light how its pictures\n"
    "fluctuate, how wrong they are and how late, as JSON. One thread.\n\n"
    "  --box N         no scene file: a room with two boxes and a point light, of N surfaces: 16,\n"
    "                  64, 256, 1024, ... 65536\n"
    "  --photon-box N  photons meet the room of N surfaces, or with --photon-scene FILE that "
    "scene\n"
    "  --repeats N     of timing each stage, medians are given (default 25; 0: no timing)\n"
    "  --light HOW     frames, of which each has one unit shot anew: still, or circle or jump "
    "with\n"
    "                  --box (default: none)\n"
    "  --frames N      how many of them are measured (default 64); for jump it is all of the pool\n"
    "  --every N       measure each N-th frame (default 1)\n"
    "  --truth N       paths of the pool that makes the truth of a moment (default 100000)\n"
    "  --truths DIR    keep truths there, and take those that are there: of the same scene and "
    "flags\n"
    "  --runs N        of unlike seeds, whose mean is the answer to a jump (default 4)\n"
    "  --pictures DIR  write the measured frames there, and their truths, as .exr\n"
    "  --help, -h      print this and end\n"
    "  --version       print the release and end\n"
    "  and the flags of ninefold-master, see there, that say what the picture is\n\n"
    "stages [ms of processor time]: shoot one unit; balance the k-d tree; build the grid; update\n"
    "the grid by one unit; estimate E of the whole picture, eye paths not included; rest: of the\n"
    "picture, with an empty pool. vertices, with --map-estimate vertices: estimates, and their "
    "time,\n"
    "at all corners of small triangles, at those turned to the eye, at each vertex once, both, "
    "and\n"
    "at those that pixels ask for. total: shoot, the index that --map-index names, estimate, "
    "rest.\n"
    "Exit status: 0 done, 1 a failure (one line on stderr), 2 wrong usage.\n";

struct Wanted {
  int surfaces = 0;     // of the box; 0: a scene file
  int photonsMeet = 0;  // surfaces of another box; 0: the same
  int repeats = 25, every = 1, truth = 100'000, runs = 4;
  std::string light, pictures, truths;
  Options options;
};

// n of n x n, into which each surface is cut.
int cutsOf(int surfaces) {
  for (int n = 1; n <= 64; n *= 2)
    if (surfaces == kBoxSurfaces * n * n) return n;
  failUsage("--box {}: must be 16, 64, 256, 1024, 4096, 16384 or 65536", surfaces);
}

Wanted wantedOf(Words words) {
  Wanted w;
  w.surfaces = words.takeWhole("box", 0, kBoxSurfaces, 65536);
  w.photonsMeet = words.takeWhole("photon-box", 0, kBoxSurfaces, 65536);
  w.repeats = words.takeWhole("repeats", w.repeats, 0, 100'000);
  w.every = words.takeWhole("every", w.every, 1, 100'000);
  w.truth =
      words.takeWhole("truth", w.truth, 1, static_cast<int>(settingOf(&Settings::mapPhotons).high));
  w.runs = words.takeWhole("runs", w.runs, 1, 100'000);
  w.light = words.take("light").value_or("");
  w.pictures = words.take("pictures").value_or("");
  w.truths = words.take("truths").value_or("");
  words.addIfMissing("output", "none.exr");  // a run needs one
  words.addIfMissing("method", "photon-map");
  if (w.surfaces > 0) words.add("box");
  w.options = words.options();
  const Options& o = w.options;
  if (isLive(o) || !o.stop.frames) failUsage("only --frames ends a run of this program");
  if (!factsOf(o.settings.method).has(kMapPhotons)) failUsage("needs --method photon-map");
  if (!w.light.empty() && w.light != "still" && w.light != "circle" && w.light != "jump")
    failUsage("--light {}: must be still, circle or jump", w.light);
  if (w.photonsMeet > 0 && (w.surfaces == 0 || w.options.photonScene))
    failUsage("--photon-box goes with --box, and without --photon-scene");
  if (w.surfaces == 0 && (w.light == "circle" || w.light == "jump"))
    failUsage("--light {}: only the lamp of --box N moves", w.light);
  if (w.light != "jump" && !w.light.empty() && *o.stop.frames < 2)
    failUsage("--frames 1: two at least, or there is no variance");
  return w;
}

Json settingsOf(const Settings& s) {
  return {{"width", s.width},
          {"height", s.height},
          {"map_photons", s.mapPhotons},
          {"map_photons_per_frame", s.mapPerFrame},
          {"path_length", s.pathLength},
          {"map_nearest", s.mapNearest},
          {"map_distance", s.mapDistance},
          {"map_direct", textOf(s.mapDirect)},
          {"map_distribution", textOf(s.mapDistribution)},
          {"map_index", textOf(s.mapIndex)},
          {"map_estimate", textOf(s.mapEstimate)},
          {"map_subdivision", s.mapSubdivision}};
}

Json stagesOf(const Scene& scene, const Settings& settings, int repeats) {
  const Tracer tracer(scene, Isa::automatic);
  const MapStages s = StageTimer(tracer, settings).measure(repeats);
  const bool balances = settings.mapIndex == MapIndex::tree;
  Json vertices;
  for (const VertexStage& v : s.vertices) vertices[v.name] = Json{{"count", v.count}, {"ms", v.ms}};
  return {{"repeats", repeats},
          {"hits", s.hits},
          {"hits_per_unit", s.perUnit},
          {"shoot_ms", s.shoot},
          {"balance_ms", s.balance},
          {"build_ms", s.build},
          {"update_ms", s.update},
          {"estimate_ms", s.estimate},
          {"rest_ms", s.rest},
          {"vertices", vertices},
          {"total_ms", s.shoot + (balances ? s.balance : s.build) + s.estimate + s.rest}};
}

Json jumpOf(const MapMotion& motion, const Settings& settings, int runs) {
  const std::vector<double> response = motion.response(runs);
  const int parts = settings.mapPhotons / settings.mapPerFrame;
  return {{"light", "jump"},
          {"runs", runs},
          {"lag_frames", lagOf(response)},
          {"lag_theory", (95 * parts + 99) / 100},
          {"response", response}};
}

Json fluctuationOf(const MapMotion& motion, const Wanted& w) {
  const auto frames = static_cast<int>(*w.options.stop.frames);
  const auto write = [&](int frame, const RgbImage& picture, const RgbImage& truth) {
    if (w.pictures.empty()) return;
    writeImage(fmt::format("{}/frame_{:04}.exr", w.pictures, frame), {picture, {}, {}});
    writeImage(fmt::format("{}/truth_{:04}.exr", w.pictures, frame), {truth, {}, {}});
  };
  const Fluctuation f = motion.fluctuation(frames, w.every, w.light == "circle", write);
  double mean = 0;
  for (const double e : f.relMse) mean += e / frames;
  return {{"light", w.light},       {"frames", frames},       {"every", w.every},
          {"truth_paths", w.truth}, {"variance", f.variance}, {"error_variance", f.errorVariance},
          {"flicker", f.flicker},   {"relmse_mean", mean},    {"relmse", f.relMse}};
}

Scene sceneOf(const Wanted& w) {
  Scene scene = w.surfaces > 0 ? MapBox::make(cutsOf(w.surfaces))
                               : readScene(w.options.scene, w.options.reading);
  if (w.photonsMeet > 0) addPhotonScene(scene, MapBox::make(cutsOf(w.photonsMeet)));
  return withPhotonScene(std::move(scene), w.options.photonScene);
}

int run(int argc, char** argv) {
  const Words words(argc, argv);
  if (words.has("--help") || words.has("-h")) return writeOutput(kHelp), 0;
  if (words.has("--version")) return writeOutput(versionText(kProgram)), 0;
  const Wanted w = wantedOf(words);
  const Scene scene = sceneOf(w);
  Settings settings = makeSettings(w.options, scene);
  Json all{{"scene", scene.name}, {"settings", settingsOf(settings)}};
  if (w.surfaces > 0) all["surfaces"] = w.surfaces;
  if (w.photonsMeet > 0) all["photons_meet"] = w.photonsMeet;
  if (w.repeats > 0) all["stages"] = stagesOf(scene, settings, w.repeats);
  if (!w.light.empty()) {
    settings.jitter = false;
    const MapTruth truth(scene, settings, w.truth, w.truths);
    const MapMotion motion(scene, settings, truth);
    all["motion"] = w.light == "jump" ? jumpOf(motion, settings, w.runs) : fluctuationOf(motion, w);
  }
  return writeOutput(all.dump() + "\n"), 0;
}

}  // namespace
}  // namespace ninefold

int main(int argc, char** argv) {
  return ninefold::runProgram(ninefold::kProgram, [&] { return ninefold::run(argc, argv); });
}
