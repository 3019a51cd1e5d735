// ninefold-selective-photons SCENE --edit FILE [options]: how soon the photons that an edit
// concerns are traced anew, and what steps cost: Figures 5 to 7 of Dmitriev et al. 2002 for one
// choice of settings, as JSON. One process, one thread.
//
// Exit status: 0 done, 1 a failure, 2 wrong usage.

#include <nlohmann/json.hpp>
#include <unordered_map>

#include "common/base/cpu_time.h"
#include "common/base/program.h"
#include "common/base/release.h"
#include "common/base/standard_streams.h"
#include "common/gi/selective/group_pages.h"
#include "common/gi/whole_state.h"
#include "common/scene/methods.h"
#include "common/scene/reader.h"
#include "common/tracing/tracer.h"
#include "master/options/script.h"
#include "tools/group_paths.h"
#include "tools/words.h"

namespace ninefold {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kProgram = "ninefold-selective-photons";
constexpr const char* kHelp =
    "Usage: ninefold-selective-photons SCENE --edit FILE [options]\n\n"
    "How soon the photons that an edit concerns are traced anew, as JSON. One thread.\n\n"
    "  --edit FILE     a script (docs/script.md); the edit is all that it has done at its end\n"
    "  --units N       groups of a step, each step in the order that the one before tells\n"
    "                  (default: as many as a step in motion has)\n"
    "  --paths A,B     of some photons of groups A and B: their paths after the edit\n"
    "  --help, -h      print this and end\n"
    "  --version       print the release and end\n"
    "  and the flags of ninefold-master, see there, that say what the picture is\n\n"
    "amiss: hits that lie elsewhere, or carry other light, than in a fresh start; found: the "
    "share\n"
    "of them that is right after so many units; seconds: processor time of those units. edit:\n"
    "processor time until units can be traced. elements:\n"
    "processor time until what photons left is ready to be asked: in a fresh start, after the\n"
    "edit, and after all units.\n"
    "Exit status: 0 done, 1 a failure (one line on stderr), 2 wrong usage.\n";

struct Wanted {
  std::string edit;
  int units = 0;
  std::vector<uint32_t> paths;
  Options options;
};

Wanted wantedOf(Words words) {
  Wanted w;
  w.edit = words.take("edit").value_or("");
  w.units = words.takeWhole("units", 0, 1, 20160);
  if (const auto text = words.take("paths")) {
    const size_t comma = text->find(',');
    if (comma == std::string::npos) failUsage("--paths {}: two groups, as 17,200", *text);
    for (const std::string& part : {text->substr(0, comma), text->substr(comma + 1)})
      w.paths.push_back(static_cast<uint32_t>(parseWhole("paths", part, 0, 20160)));
  }
  words.addIfMissing("output", "none.exr");  // a run needs one
  words.addIfMissing("frames", "1");
  words.addIfMissing("method", "selective-photons");
  w.options = words.options();
  if (isLive(w.options)) failUsage("only --edit says what happens");
  if (!factsOf(w.options.settings.method).has(kElementPhotons))
    failUsage("needs --method selective-photons");
  if (w.edit.empty()) failUsage("--edit is missing: a script that says what changes");
  return w;
}

// How often each hit of the pool is there; a hit by all that it holds.
using Hits = std::unordered_map<uint64_t, int>;

Hits hitsOf(const StatePages& pages, const Settings& settings) {
  const PhotonGroups groups(settings);
  const GroupPages rows(groups);
  Hits hits;
  for (uint32_t r = 0; r < groups.rows(); ++r)
    if (const auto row = rows.read(pages, r))
      for (const ElementHit& h : row->hits)
        ++hits[hashWords(uint64_t{h.surface} << 32 | h.flux, uint64_t{h.u} << 16 | h.v)];
  return hits;
}

// Hits of `wanted` that `there` lacks.
int64_t missing(const Hits& wanted, const Hits& there) {
  int64_t count = 0;
  for (const auto& [hit, times] : wanted) {
    const auto found = there.find(hit);
    count += std::max(times - (found == there.end() ? 0 : found->second), 0);
  }
  return count;
}

int64_t allOf(const Hits& hits) {
  int64_t count = 0;
  for (const auto& [hit, times] : hits) count += times;
  return count;
}

double seconds(Duration time) { return std::chrono::duration<double>(time).count(); }

// Calls make(), and adds its processor time to `times`.
template <typename Make>
auto timed(Json& times, const char* name, const Make& make) {
  const Duration start = threadCpuTime();
  auto made = make();
  times[name] = seconds(threadCpuTime() - start);
  return made;
}

Json update(const Renderer& before, const Renderer& after, const StatePages& afresh,
            const Settings& settings, int wanted) {
  const StateFacts& facts = *factsOf(settings.method).state;
  const uint32_t all = facts.unitsOfAll(settings);
  const uint32_t step = wanted > 0 ? static_cast<uint32_t>(wanted) : facts.unitsInMotion(settings);
  StatePages pages = stateAtRest(before, settings, 0);
  const Hits fresh = hitsOf(afresh, settings);
  const auto amiss = missing(fresh, hitsOf(pages, settings));
  Json elements;
  auto light = timed(elements, "fresh", [&] { return before.digest(pages, nullptr); });
  light = timed(elements, "edited", [&] { return after.digest(pages, light.get()); });
  Duration spent{0};
  RayCounts rays;
  Json curve = Json::array();
  for (uint32_t done = 0; done < all;) {
    const StatePages from = pages;
    StepKey key;
    const uint32_t units = std::min(step, all - done);
    key.from = 1, key.firstUnit = done, key.units = units;
    const Duration start = threadCpuTime();
    std::vector<StepResult> results;
    for (uint32_t unit = 0; unit < units; ++unit)
      results.push_back(after.step(from, key, done + unit));
    spent += threadCpuTime() - start;
    for (const StepResult& result : results) pages.apply(result.deltas), rays += result.rays;
    done += units;
    const auto left = missing(fresh, hitsOf(pages, settings));
    const double found =
        amiss == 0 ? 1 : 1 - static_cast<double>(left) / static_cast<double>(amiss);
    curve.push_back({{"units", done},
                     {"photons", uint64_t{done} * static_cast<uint64_t>(settings.photonPool) / all},
                     {"seconds", seconds(spent)},
                     {"found", found}});
  }
  timed(elements, "renewed", [&] { return after.digest(pages, light.get()); });
  uint64_t bytes = 0;
  for (const auto& [id, page] : pages.all())
    if (const auto* records = std::get_if<Records>(page.get())) bytes += records->size();
  return {{"hits", allOf(fresh)}, {"amiss", amiss},       {"state_bytes", bytes},
          {"rays", rays.total()}, {"elements", elements}, {"curve", curve}};
}

int run(int argc, char** argv) {
  const Words words(argc, argv);
  if (words.has("--help") || words.has("-h")) return writeOutput(kHelp), 0;
  if (words.has("--version")) return writeOutput(versionText(kProgram)), 0;
  const Wanted w = wantedOf(words);
  const Scene scene = readScene(w.options.scene, w.options.reading);
  const Settings settings = makeSettings(w.options, scene);
  const Script script = readScript(w.edit, scene);
  const SceneEdit edit = script.at(script.seconds, scene, settings.camera).edit;
  const Tracer tracer(scene, Isa::automatic);
  const Renderer before(tracer, settings);
  Json edits;
  const Scene changed = timed(edits, "scene", [&] { return edited(scene, edit); });
  const auto tracerAfter = timed(edits, "tracer", [&] {
    return std::make_unique<const Tracer>(tracer, changed, movedInstances(scene, edit));
  });
  const auto after = timed(edits, "renderer", [&] {
    return std::make_unique<const Renderer>(*tracerAfter, settings, &before, &before);
  });
  const StatePages fresh = stateAtRest(Renderer(*tracerAfter, settings, &before), settings, 0);
  Json all{{"scene", scene.name},
           {"edit", edits},
           {"photon_groups", settings.photonGroups},
           {"photon_pool", settings.photonPool},
           {"pilot_ratio", settings.pilotRatio}};
  all.update(update(before, *after, fresh, settings, w.units));
  const PhotonGroups groups(settings);
  const Transport began(tracer, settings), transport(*tracerAfter, settings, &began);
  for (const uint32_t group : w.paths) {
    if (group >= groups.groups())
      failUsage("--paths {}: there are {} groups", group, groups.groups());
    all["paths"].push_back(groupPaths(transport, groups, group));
  }
  return writeOutput(all.dump() + "\n"), 0;
}

}  // namespace
}  // namespace ninefold

int main(int argc, char** argv) {
  return ninefold::runProgram(ninefold::kProgram, [&] { return ninefold::run(argc, argv); });
}
