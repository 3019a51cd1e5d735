// ninefold-replay-task SCENE --frame F --tile T --phase P [options]: one task of a run once more,
// alone in one thread of one process: for a debugger, and to find where a value came from.
//
//   --recording FILE   as a real client was asked for it (ninefold-client --record FILE), to the
//                      bit, edits and gestures included; its result then is compared with this one
//   else               by the flags of ninefold-master, as its headless run or a client's replay
//                      line has them
//
// Prints what it is, a hash of the decoded tile, values that were no light, and times.
// Exit status: 0 done, 1 a failure, or another result than the recorded one, 2 wrong usage.

#include <ranges>

#include "client/render_job.h"
#include "common/base/log.h"
#include "common/base/program.h"
#include "common/base/release.h"
#include "common/base/standard_streams.h"
#include "common/scene/camera_choice.h"
#include "common/scene/methods.h"
#include "common/scene/needs.h"
#include "common/scene/photon_scene.h"
#include "common/scene/reader.h"
#include "master/options/options.h"
#include "master/running/frame_plan.h"
#include "master/running/job.h"
#include "proto/recording.h"
#include "proto/scene_blobs.h"
#include "proto/tile_names.h"
#include "proto/wire_level.h"
#include "tools/recorded_run.h"
#include "tools/tile_hash.h"

namespace ninefold {
namespace {

Scene sceneOf(const Options& options) {
  return withPhotonScene(readScene(options.scene, options.reading), options.photonScene);
}

constexpr const char* kProgram = "ninefold-replay-task";
constexpr const char* kHelp =
    "Usage: ninefold-replay-task SCENE --frame F --tile T --phase P [options]\n\n"
    "One task of a run once more, alone in one thread of one process: for a debugger.\n\n"
    "  --frame N       its frame; N:RANDOMIZATION:ROTATION:RADIUS if it is not that of a headless\n"
    "                  run\n"
    "  --tile N        its tile\n"
    "  --phase N       its phase\n"
    "  --light-cameras C/C/...  that its light is made for, if not for the picture's\n"
    "  --recording F   as a client that ran with --record F was asked for it; the scene is the "
    "one\n"
    "                  that the master had; of the flags of ninefold-master only --isa and --clip\n"
    "  --help, -h      print this and end\n"
    "  --version       print the release and end\n"
    "  and the flags of ninefold-master, see there, that say what the picture is\n\n"
    "Exit status: 0 done, 1 a failure (one line on stderr), or another result than the recorded\n"
    "one, 2 wrong usage.\n";

// Our own flags, and the rest for ninefold-master's.
struct CommandLine {
  bool help = false, version = false;
  std::optional<std::string> frame, tile, phase, lightCameras, recording;
  std::vector<std::string> rest;
};

CommandLine parseCommandLine(int argc, char** argv) {
  CommandLine line;
  const std::pair<std::string, std::optional<std::string>*> flags[] = {
      {"--frame", &line.frame},
      {"--tile", &line.tile},
      {"--phase", &line.phase},
      {"--light-cameras", &line.lightCameras},
      {"--recording", &line.recording}};
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    line.help |= word == "--help" || word == "-h", line.version |= word == "--version";
    const auto flag = std::ranges::find_if(
        flags, [&](const auto& f) { return word == f.first || word.starts_with(f.first + "="); });
    if (flag == std::end(flags))
      line.rest.push_back(word);
    else if (word != flag->first)
      *flag->second = word.substr(flag->first.size() + 1);
    else if (++i < argc)
      *flag->second = argv[i];
    else
      failUsage("{} needs a value", word);
  }
  return line;
}

uint32_t number(const char* flag, const std::optional<std::string>& text) {
  if (!text) failUsage("--{} is missing; see {} --help", flag, kProgram);
  return static_cast<uint32_t>(parseWhole(flag, *text, 0, std::numeric_limits<int32_t>::max()));
}

TaskPlace placeOf(const CommandLine& line) {
  std::optional<std::string> frame = line.frame;
  if (frame) frame = frame->substr(0, frame->find(':'));
  return {number("frame", frame), number("tile", line.tile), number("phase", line.phase)};
}

Options masterOptions(const CommandLine& line) {
  if (line.rest.empty() && !processVariable(variableOfFlag("scene")))
    failUsage("SCENE is missing; see {} --help", kProgram);
  std::vector<const char*> words{kProgram};
  for (const std::string& word : line.rest) words.push_back(word.c_str());
  // A run needs one; nothing is written.
  if (std::ranges::none_of(line.rest, [](const auto& w) { return w.starts_with("--output"); }))
    words.push_back("--output=none.exr");
  Options options = parseOptions(static_cast<int>(words.size()), words.data(), processVariable, 1);
  if (isLive(options)) failUsage("only tasks of --recording are of a window, script or animation");
  return options;
}

Isa isaNamed(const std::string& name) {
  return name == "avx512" ? Isa::avx512 : name == "avx2" ? Isa::avx2 : Isa::automatic;
}

// As clients have it, from the wire.
std::shared_ptr<const TracedScene> traced(const std::vector<Blob>& blobs, Isa isa) {
  std::vector<BlobInfo> manifest;
  std::vector<Bytes> raw;
  for (const Blob& blob : blobs) {
    manifest.push_back(blob.info);
    raw.push_back(unpackBlob(blob.info, blob.compressed));
  }
  return std::make_shared<const TracedScene>(
      std::make_shared<const Scene>(unpackScene(manifest, raw)), isa);
}

struct TaskAgain {
  std::shared_ptr<const TracedScene> scene;
  Settings settings;
  Delivery delivery;
  FrameKey frame;
  msg::TaskItem item;
  float neighbourWeight = 1;
  std::optional<msg::Result> recorded = {};
  std::optional<StatePages> state = {};  // of the method; none: as at rest
};

void warnOfAnotherClass(const msg::Hello& client, Isa isa) {
  if (client.release != releaseName())
    warn("recorded by Ninefold {}, this is {}: the result may differ", client.release,
         releaseName());
  else if (client.probeClass != probeClass(isa))
    warn("recorded on a machine whose pixels differ slightly from this one's ({})", client.isa);
}

TaskAgain fromRecording(const CommandLine& line, const TaskPlace& place) {
  for (const std::string& word : line.rest)
    if (word.starts_with("--") && !word.starts_with("--isa") && !word.starts_with("--clip") &&
        !word.starts_with("--photon-scene"))
      failUsage("{}: with --recording the picture is the recorded one; leave it out", word);
  if (line.lightCameras)
    failUsage("--light-cameras: with --recording they are the recorded ones; leave it out");
  const Options options = masterOptions(line);
  RecordedTask found = RecordedRun(readRecording(*line.recording)).find(place);
  const Isa isa = isaNamed(options.isa == "auto" ? found.client.isa : options.isa);
  warnOfAnotherClass(found.client, isa);

  const std::vector<Blob> blobs = packScene(sceneOf(options));
  if (!std::ranges::equal(blobs, found.scene, {}, &Blob::info))
    fail("{}: is not the scene of {}; give the file that the master had then", options.scene,
         *line.recording);
  std::shared_ptr<const TracedScene> scene = traced(blobs, isa);
  SceneEdit all;
  for (const msg::Edit& edit : found.edits) {
    checkEdit(*scene->asFetched, edit.edit);
    merge(all, edit.edit);
    if (!edit.more) scene = TracedScene::after(scene, all, edit.moving);
  }
  return {scene,      found.job.settings,          found.job.delivery, found.order.frame,
          found.item, found.order.neighbourWeight, found.result,       found.state};
}

// Of a headless run: its plan's, unless it is given whole.
FrameKey frameOf(const std::string& text, uint32_t number, FramePlan& plan) {
  FrameKey key;
  if (text.find(':') == std::string::npos) {
    while (plan.opened() <= int64_t{number}) key = plan.next();
    return key;
  }
  const std::vector<double> parts = parseNumbers("frame", text, ':');
  if (parts.size() != 4)
    failUsage("--frame {}: must be N or N:RANDOMIZATION:ROTATION:RADIUS", text);
  constexpr double kMost = std::numeric_limits<uint32_t>::max();
  for (const size_t i : {0u, 1u, 2u}) checkRange("frame", parts[i], 0.0, kMost);
  checkRange("frame", parts[3], 0.0, double{std::numeric_limits<float>::max()});
  key = {static_cast<uint32_t>(parts[0]), static_cast<uint32_t>(parts[1]),
         static_cast<uint32_t>(parts[2]), static_cast<float>(parts[3])};
  return key;
}

// "C/C/...", each as --camera has it.
std::vector<Camera> camerasOf(const Scene& scene, std::string_view text) {
  std::vector<Camera> cameras;
  for (const auto part : std::views::split(text, '/'))
    cameras.push_back(chooseCamera(scene, std::string_view(part.begin(), part.end())));
  if (cameras.size() > kMostLightCameras)
    failUsage("--light-cameras: {} are given, at most {} can be", cameras.size(),
              kMostLightCameras);
  return cameras;
}

TaskAgain fromFlags(const CommandLine& line, const TaskPlace& place) {
  const Options options = masterOptions(line);
  const Job job = makeJob(options);
  FramePlan plan(job.firstPhotonRadius, job.settings.interleave.sets(), options.converging);
  FrameKey frame = frameOf(*line.frame, place.frame, plan);
  const float weight = plan.neighbourWeight(place.frame);
  const Scene scene = sceneOf(options);
  if (line.lightCameras) frame.lightCameras = camerasOf(scene, *line.lightCameras);
  // Any version but 0, which has no pages.
  if (factsOf(job.settings.method).state != nullptr) frame.state = frame.randomization + 1;
  return {traced(packScene(scene), isaNamed(options.isa)), job.settings, job.delivery, frame,
          {place.tile, place.phase, job.shape.extraMask},  weight};
}

TileShape shapeOf(const TaskAgain& task) {
  const Settings& s = task.settings;
  const TileGrid grid(s.width, s.height, s.interleave);
  const int phases = task.delivery.wholeTiles() ? 1 : s.interleave.sets();
  const bool exists = task.item.tile < static_cast<uint32_t>(grid.tiles()) &&
                      task.item.phase < static_cast<uint32_t>(phases);
  if (!exists)
    fail("tile {}, phase {}: there are {} tiles of {} phases", task.item.tile, task.item.phase,
         grid.tiles(), phases);
  const Needs needs = needsOf(*task.scene->scene, s.environment);
  const TileShape shape =
      shapeOf(grid, task.item, task.delivery.form, layerMaskOf(needs, s.method));
  if (shape.width * shape.height == 0)
    fail("tile {} has no pixel of phase {}", task.item.tile, task.item.phase);
  return shape;
}

std::string describe(const msg::Result& result) {
  const double ms = 1e-6 * static_cast<double>(result.busyNs);
  const RayCounts& rays = result.rays;
  return fmt::format(
      "{:.3f} ms with {} light set(s); rays: {} of the eye, {} shadow, {} photon, {} compensation\n"
      "values that are not finite or negative: {}{}\n",
      ms, result.setsMade, rays.eye, rays.shadow, rays.photon, rays.compensation, result.replaced,
      result.replaced > 0 ? ", in " + namesOfFields(result.replacedIn) : "");
}

void replay(const TaskAgain& task) {
  const TileShape shape = shapeOf(task);
  RenderJob job(task.scene, 1, task.settings, task.delivery, 1);
  const StatePages state = task.state ? *task.state : job.stateAtRest(task.frame.randomization);
  const msg::Result result = job.run(
                                    task.frame, task.item, task.neighbourWeight, WireLevel::kLight,
                                    0, [] { return Clock::now(); }, state)
                                 .result;
  const std::string hash = TileHash::of(result.encoded, shape);
  writeOutput(fmt::format("frame {}, tile {}, phase {}: {}x{} pixels, {}\nhash {}\n{}",
                          task.frame.frame, task.item.tile, task.item.phase, shape.width,
                          shape.height, task.scene->tracer.isaName(), hash, describe(result)));
  if (!task.recorded) return;
  const std::string then = TileHash::of(task.recorded->encoded, shape);
  writeOutput(fmt::format("recorded {}, {}", then, describe(*task.recorded)));
  if (then != hash) fail("the recorded result is another one: {} then, {} now", then, hash);
}

int run(int argc, char** argv) {
  const CommandLine line = parseCommandLine(argc, argv);
  if (line.help) return writeOutput(kHelp), 0;
  if (line.version) return writeOutput(versionText(kProgram)), 0;
  const TaskPlace place = placeOf(line);
  replay(line.recording ? fromRecording(line, place) : fromFlags(line, place));
  return 0;
}

}  // namespace
}  // namespace ninefold

int main(int argc, char** argv) {
  return ninefold::runProgram("ninefold-replay-task", [&] { return ninefold::run(argc, argv); });
}
