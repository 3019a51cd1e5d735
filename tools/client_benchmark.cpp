// ninefold-client-benchmark SCENE [options]: what a frame costs a client, part by part, beside the
// time that its rays alone take in a tight loop, in the same run.
//
// One thread renders whole frames task by task, as a client does: light sets, tiles, encoding. Then
// the same rays go through Embree again with nothing around them: *bare* time. Times are the
// thread's own CPU time, so that other programs on the machine disturb little.
// Exit status: 0 done, 1 a failure, 2 wrong usage.

#include <fmt/core.h>

#include <ctime>
#include <nlohmann/json.hpp>

#include "common/gi/renderer.h"
#include "common/scene/reader.h"
#include "common/scene/settings_table.h"
#include "common/tracing/ray_log.h"
#include "proto/tile_codec.h"
#include "tools/command.h"

namespace ninefold {
namespace {

namespace po = boost::program_options;

struct Options {
  std::string scene, size = "640x480", isa = "auto";
  int frames = 4, level = 1;
  Settings settings;
  bool noCompensation = false, json = false;
};

double threadSeconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// Seconds of each part, summed over the frames.
struct Cost {
  double sets = 0, tiles = 0, encoding = 0, bare = 0;
  uint64_t rays = 0, bytes = 0;
  double whole() const { return sets + tiles + encoding; }
};

// As the master's flags of the same names.
void checkSettings(const Settings& s) {
  const auto check = [&](const auto& row) {
    checkRange(row.name, static_cast<double>(s.*row.member), row.low, row.high);
  };
  check(settingOf(&Settings::directVpls));
  check(settingOf(&Settings::indirectVpls));
  check(settingOf(&Settings::photons));
  check(settingOf(&Settings::vplRoulette));
}

Settings settingsFor(const Options& o, const Scene& scene) {
  Settings s = o.settings;
  const auto [width, height] = parseSize(o.size);
  s.width = width, s.height = height;
  s.camera = scene.cameras.front();
  s.environment = scene.environment;
  s.compensate = !o.noCompensation;
  return s;
}

// Traces the logged rays once more; returns something of each answer, so that none is left out.
uint64_t traceBare(const Tracer& tracer, RayLog& log) {
  uint64_t seen = 0;
  Hit hits[kPacket];
  for (RayLog::Packet& p : log.packets) {
    if (p.occlusion)
      seen += tracer.occluded16(p.rays, p.active, p.coherent);
    else
      tracer.closest16(p.rays, p.active, hits, p.coherent), seen += hits[0].triangle;
  }
  for (const RayLog::Single& s : log.singles)
    seen += s.occlusion ? uint64_t{tracer.occluded(s.origin, s.direction, s.tFar)}
                        : tracer.closest(s.origin, s.direction, s.tFar).triangle;
  return seen;
}

class Bench {
 public:
  Bench(const Scene& scene, const Options& options, Isa isa)
      : tracer_(scene, isa),
        settings_(settingsFor(options, scene)),
        renderer_(tracer_, settings_),
        scratch_(renderer_.makeScratch()),
        grid_(settings_.width, settings_.height, settings_.interleave),
        level_(options.level) {}

  // One frame; `log` decides whether it is timed, or its rays are kept and traced bare.
  void frame(uint32_t index, bool log, Cost& cost) {
    const FrameKey key{index, index, index,
                       settings_.photonRadius * tracer_.scene().bounds.radius()};
    for (int phase = 0; phase < settings_.interleave.sets(); ++phase) {
      attach(log);
      const double start = threadSeconds();
      const auto set = lightSetOfPhase(phase, key.rotation, settings_.interleave.sets());
      const auto lights = renderer_.light(key, set);
      if (!log) cost.sets += threadSeconds() - start, cost.rays += lights->rays.total();
      if (log) bare(cost);
      for (int tile = 0; tile < grid_.tiles(); ++tile) task(key, tile, phase, *lights, log, cost);
    }
  }
  const std::string& isaName() const { return tracer_.isaName(); }
  // Depends on every answer of the bare rays, so that the compiler leaves none out.
  uint64_t answers() const { return answers_; }

 private:
  void attach(bool log) { tracer_.logTo(log ? &log_ : nullptr); }

  void task(const FrameKey& key, int tile, int phase, const FrameLight& lights, bool log,
            Cost& cost) {
    attach(log);
    const double start = threadSeconds();
    renderer_.render(Task{key, tile, phase, 0}, lights, *scratch_, tile_);
    if (log) return bare(cost);
    const double rendered = threadSeconds();
    const auto encoded = encoder_.encode(
        tile_,
        ditherKey(settings_.seed, key, static_cast<uint32_t>(tile), static_cast<uint32_t>(phase)),
        level_);
    cost.tiles += rendered - start;
    cost.encoding += threadSeconds() - rendered;
    cost.rays += tile_.rays.total();
    cost.bytes += encoded.bytes.size();
  }

  void bare(Cost& cost) {
    attach(false);
    const double start = threadSeconds();
    answers_ += traceBare(tracer_, log_);
    cost.bare += threadSeconds() - start;
    log_.clear();
  }

  Tracer tracer_;
  Settings settings_;
  Renderer renderer_;
  std::unique_ptr<Scratch> scratch_;
  TileGrid grid_;
  int level_;
  TileResult tile_;
  TileEncoder encoder_;
  RayLog log_;
  uint64_t answers_ = 0;
};

void report(const Options& o, const std::string& isa, const Cost& c) {
  const double frames = o.frames;
  const auto ms = [&](double seconds) { return 1e3 * seconds / frames; };
  if (o.json) {
    writeOutput(nlohmann::ordered_json{{"scene", o.scene},
                                       {"isa", isa},
                                       {"frames", o.frames},
                                       {"bare_ms", ms(c.bare)},
                                       {"sets_ms", ms(c.sets)},
                                       {"tiles_ms", ms(c.tiles)},
                                       {"encoding_ms", ms(c.encoding)},
                                       {"whole_ms", ms(c.whole())},
                                       {"bare_ratio", c.bare / c.whole()},
                                       {"rays_per_frame", static_cast<double>(c.rays) / frames},
                                       {"bytes_per_frame", static_cast<double>(c.bytes) / frames}}
                    .dump(2) +
                "\n");
    return;
  }
  writeOutput(fmt::format(
      "{} ({}): {:.1f} ms a frame: sets {:.1f}, tiles {:.1f}, encoding {:.1f}; bare rays {:.1f} "
      "ms, "
      "ratio {:.3f}; {:.2f} Mrays, {:.0f} kB a frame\n",
      o.scene, isa, ms(c.whole()), ms(c.sets), ms(c.tiles), ms(c.encoding), ms(c.bare),
      c.bare / c.whole(), 1e-6 * static_cast<double>(c.rays) / frames,
      1e-3 * static_cast<double>(c.bytes) / frames));
}

Isa isaFrom(const std::string& name) {
  if (name == "avx2") return Isa::avx2;
  if (name == "avx512") return Isa::avx512;
  if (name != "auto") failUsage("--isa {}: must be auto, avx2 or avx512", name);
  return Isa::automatic;
}

int run(int argc, char** argv) {
  Options o;
  Command command{"ninefold-client-benchmark", "SCENE [options]",
                  "Tells what a frame costs a client, part by part, beside its rays alone.\n"};
  command.words = {{"SCENE", &o.scene}};
  command.flags.add_options()("size", po::value(&o.size), "WxH, default 640x480")(
      "frames", po::value(&o.frames), "how many frames to measure, default 4")(
      "direct-vpls", po::value(&o.settings.directVpls), "per set, default as the master's")(
      "indirect-vpls", po::value(&o.settings.indirectVpls), "per set, mean, the same")(
      "photons", po::value(&o.settings.photons), "per set, the same")(
      "level", po::value(&o.level), "zstd level of the tiles, default 1; 0 = none")(
      "vpl-roulette", po::value(&o.settings.vplRoulette),
      "default as the master's; 0 = every virtual light is asked")(
      "no-compensation", po::bool_switch(&o.noCompensation), "leave the bound's energy out")(
      "isa", po::value(&o.isa), "auto, avx2 or avx512")("json", po::bool_switch(&o.json),
                                                        "write one JSON object");
  if (!parseCommandLine(argc, argv, command)) return 0;
  checkRange("frames", o.frames, 1, 1'000'000);
  checkSettings(o.settings);
  const Scene scene = readScene(o.scene);
  Bench bench(scene, o, isaFrom(o.isa));
  Cost cost, warm;
  bench.frame(0, false, warm);
  // Timed and bare frames take turns: what slows the machine down slows both.
  for (uint32_t i = 1; i <= static_cast<uint32_t>(o.frames); ++i) {
    bench.frame(i, false, cost);
    bench.frame(i, true, cost);
  }
  report(o, bench.isaName(), cost);
  return bench.answers() == ~uint64_t{0} ? 1 : 0;
}

}  // namespace
}  // namespace ninefold

int main(int argc, char** argv) {
  return ninefold::runProgram("ninefold-client-benchmark",
                              [&] { return ninefold::run(argc, argv); });
}
