// ninefold-virtual-lights SCENE [options]: which virtual point lights a run uses, as JSON, without
// rendering: what share of them was found from the camera, where they stand, what they cost.
//
//   --frames N   of so many frames; one, if it is not given
//   and the flags of ninefold-master that say what the picture is
//
// Exit status: 0 done, 1 a failure, 2 wrong usage.

#include <nlohmann/json.hpp>

#include "common/base/clock.h"
#include "common/base/program.h"
#include "common/base/release.h"
#include "common/base/standard_streams.h"
#include "common/gi/light_set/light_set.h"
#include "common/gi/renderer.h"
#include "common/scene/methods.h"
#include "common/scene/reader.h"
#include "master/options/options.h"
#include "master/running/frame_plan.h"
#include "master/running/job.h"

namespace ninefold {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kProgram = "ninefold-virtual-lights";
constexpr const char* kHelp =
    "Usage: ninefold-virtual-lights SCENE [options]\n\n"
    "Which virtual point lights a run uses, as JSON, without rendering.\n\n"
    "  --frames N      of so many frames (default 1)\n"
    "  --help, -h      print this and end\n"
    "  --version       print the release and end\n"
    "  and the flags of ninefold-master, see there, that say what the picture is\n\n"
    "lights: one a virtual light: frame, set, family (lamp, standard, reverse), position [m] (of\n"
    "the sun: its direction), power [W/sr], and the share of the view that it is not hidden from.\n"
    "Exit status: 0 done, 1 a failure (one line on stderr), 2 wrong usage.\n";

bool has(int argc, char** argv, std::string_view flag) {
  return std::any_of(argv + 1, argv + argc,
                     [&](std::string_view w) { return w.starts_with(flag); });
}

Options masterOptions(int argc, char** argv) {
  std::vector<const char*> words(argv, argv + argc);
  if (!has(argc, argv, "--output")) words.push_back("--output=none.exr");  // a run needs one
  if (!has(argc, argv, "--frames")) words.push_back("--frames=1");
  Options options = parseOptions(static_cast<int>(words.size()), words.data(), processVariable, 1);
  if (isLive(options)) failUsage("only a run without window, script and animation has one view");
  if (!options.stop.frames || (factsOf(options.settings.method).parts & kVpls) == 0)
    failUsage("needs --frames, and a method with virtual lights");
  return options;
}

const char* familyOf(const Vpl& vpl) {
  if (vpl.reverse) return "reverse";
  return vpl.diffuseCount > 0 || vpl.glossy >= 0 ? "standard" : "lamp";
}

Json object(uint32_t frame, int set, const Vpl& vpl) {
  const Vec3 at = vpl.kind == Vpl::Kind::directional ? vpl.normal : vpl.position;
  return {{"frame", frame},
          {"set", set},
          {"family", familyOf(vpl)},
          {"position", {at.x, at.y, at.z}},
          {"power", {vpl.power.x, vpl.power.y, vpl.power.z}},
          {"seen", vpl.seen}};
}

int run(int argc, char** argv) {
  if (has(argc, argv, "--help") || has(argc, argv, "-h")) return writeOutput(kHelp), 0;
  if (has(argc, argv, "--version")) return writeOutput(versionText(kProgram)), 0;
  const Options options = masterOptions(argc, argv);
  const Job job = makeJob(options);
  const Scene scene = readScene(options.scene, options.reading);
  const Tracer tracer(scene, Isa::automatic);
  const Renderer renderer(tracer, job.settings);
  const int sets = job.settings.interleave.sets();
  FramePlan plan(job.firstPhotonRadius, sets, options.converging);
  Json lights = Json::array();
  uint64_t rays = 0;
  Duration spent{0};
  for (int64_t i = 0; i < *options.stop.frames; ++i) {
    const FrameKey frame = plan.next();
    for (int set = 0; set < sets; ++set) {
      const Time start = Clock::now();
      const auto light = std::dynamic_pointer_cast<const LightSet>(renderer.light(frame, set));
      spent += Clock::now() - start;
      rays += light->rays.total();
      for (const Vpl& vpl : light->vpls) lights.push_back(object(frame.frame, set, vpl));
    }
  }
  const Json all{{"frames", *options.stop.frames},
                 {"sets", *options.stop.frames * sets},
                 {"seconds", std::chrono::duration<double>(spent).count()},
                 {"rays", rays},
                 {"lights", lights}};
  return writeOutput(all.dump() + "\n"), 0;
}

}  // namespace
}  // namespace ninefold

int main(int argc, char** argv) {
  return ninefold::runProgram(ninefold::kProgram, [&] { return ninefold::run(argc, argv); });
}
