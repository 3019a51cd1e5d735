// ninefold-intersection-field SCENE [options]: what a field of lines costs: size and seconds of its
// parts, and of what an edit makes anew: Tables 2 and 3 and Figure 8 of Ren et al. 2005 for one
// choice of settings, as JSON. One process, one thread.
//
// Exit status: 0 done, 1 a failure, 2 wrong usage.

#include <nlohmann/json.hpp>

#include "common/base/cpu_time.h"
#include "common/base/program.h"
#include "common/base/release.h"
#include "common/base/standard_streams.h"
#include "common/gi/intersection_field/field_size.h"
#include "common/gi/intersection_field/intersection_field.h"
#include "common/scene/methods.h"
#include "common/scene/reader.h"
#include "common/scene/world.h"
#include "common/tracing/tracer.h"
#include "master/options/script.h"
#include "tools/words.h"

namespace ninefold {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kProgram = "ninefold-intersection-field";
constexpr const char* kHelp =
    "Usage: ninefold-intersection-field SCENE [options]\n\n"
    "Size of a field of lines, and the processor time that its parts take, as JSON. One thread.\n\n"
    "  --edit FILE     a script (docs/script.md): also what all that it has done at its end makes "
    "anew\n"
    "  --help, -h      print this and end\n"
    "  --version       print the release and end\n"
    "  and the flags of ninefold-master, see there, that say what the picture is\n\n"
    "Exit status: 0 done, 1 a failure (one line on stderr), 2 wrong usage.\n";

// The value that `make` gives, and the seconds that it took.
template <typename Make>
auto timed(double& seconds, const Make& make) {
  const Duration start = threadCpuTime();
  auto made = make();
  seconds = std::chrono::duration<double>(threadCpuTime() - start).count();
  return made;
}

double surfaceOf(const Scene& scene) {
  double area = 0;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
    const auto corner = [&](uint32_t v) { return worldPoint(instance.toWorld, mesh.positions[v]); };
    for (const Triangle& t : mesh.triangles)
      area += 0.5 *
              double{glm::length(glm::cross(corner(t.y) - corner(t.x), corner(t.z) - corner(t.x)))};
  }
  return area;
}

// All parts of one scene.
struct Parts {
  std::unique_ptr<LineField> field;
  std::unique_ptr<SceneElements> elements;
  std::unique_ptr<SceneNodeLines> lines;
  std::unique_ptr<LampVisibility> lamps;
  double fieldSeconds = 0, elementSeconds = 0, nodeSeconds = 0, lampSeconds = 0;

  Parts(const Transport& t, const Parts* before) {
    elements = timed(elementSeconds, [&] {
      return std::make_unique<SceneElements>(StillScene(t.tracer, nullptr),
                                             t.settings.elementSize * t.radius,
                                             before == nullptr ? nullptr : before->elements.get());
    });
    const LineGrid grid(coverBox(t.scene), t.settings.fieldDirections, t.settings.fieldDistances);
    const LineField* known = before == nullptr ? nullptr : before->field.get();
    checkFieldSize(grid, {t.scene, coverBox(t.scene), *elements, areaLamps(t).size(), known},
                   t.settings);
    field = timed(fieldSeconds, [&] { return std::make_unique<LineField>(grid, t.scene, known); });
    lines = timed(nodeSeconds, [&] {
      return before == nullptr
                 ? std::make_unique<SceneNodeLines>(*field, t.scene, *elements, nullptr, nullptr,
                                                    nullptr)
                 : std::make_unique<SceneNodeLines>(*field, t.scene, *elements, before->field.get(),
                                                    before->elements.get(), before->lines.get());
    });
    lamps = timed(lampSeconds, [&] {
      return std::make_unique<LampVisibility>(t, *field, *elements,
                                              before == nullptr ? nullptr : before->lamps.get());
    });
  }
  Json json() const {
    return {{"field_seconds", fieldSeconds},
            {"element_seconds", elementSeconds},
            {"node_seconds", nodeSeconds},
            {"lamp_seconds", lampSeconds}};
  }
};

Json sizesOf(const Scene& scene, const Parts& parts) {
  uint64_t runs = 0, hits = 0, triangles = 0, nodes = 0;
  for (size_t i = 0; i < parts.field->instances(); ++i) {
    for (const LineRun& run : parts.field->local(i).runs()) ++runs, hits += run.count;
    triangles += scene.meshes[static_cast<size_t>(scene.instances[i].mesh)].triangles.size();
    nodes += parts.elements->block(i).nodes();
  }
  return {{"instances", scene.instances.size()},
          {"triangles", triangles},
          {"lamps", parts.lamps->lamps().size()},
          {"surface", surfaceOf(scene)},
          {"radius", scene.bounds.radius()},
          {"lines", parts.field->grid().lines()},
          {"hits", hits},
          {"runs", runs},
          {"field_bytes", parts.field->bytes()},
          {"nodes", nodes},
          {"node_bytes", parts.lines->bytes()},
          {"lamp_bytes", parts.lamps->bytes()}};
}

// The state of one frame at rest.
Json photonsOf(const Tracer& tracer, const Settings& settings) {
  const Transport transport(tracer, settings);
  const IntersectionField method(transport, nullptr);
  const View view = viewOf(transport, settings);
  RayCounts rays;
  StatePages pages;
  double seconds = 0, digestSeconds = 0;
  timed(seconds, [&] {
    for (uint32_t unit = 0; unit < fieldRows(settings); ++unit) {
      const StepResult result = method.step({}, StepKey{}, unit, view);
      pages.apply(result.deltas), rays += result.rays;
    }
    return 0;
  });
  timed(digestSeconds, [&] { return method.digest(pages, nullptr); });
  return {{"photons", settings.fieldPhotons},
          {"photon_seconds", seconds},
          {"photon_rays", rays.photon},
          {"digest_seconds", digestSeconds}};
}

int run(int argc, char** argv) {
  Words words(argc, argv);
  if (words.has("--help") || words.has("-h")) return writeOutput(kHelp), 0;
  if (words.has("--version")) return writeOutput(versionText(kProgram)), 0;
  const std::string edit = words.take("edit").value_or("");
  words.addIfMissing("output", "none.exr");  // a run needs one
  words.addIfMissing("frames", "1");
  words.addIfMissing("method", "intersection-field");
  const Options options = words.options();
  if (isLive(options)) failUsage("only --edit says what happens");
  if (!factsOf(options.settings.method).has(kFieldPhotons))
    failUsage("needs --method intersection-field");
  const Scene scene = readScene(options.scene, options.reading);
  const Settings settings = makeSettings(options, scene);
  const Tracer tracer(scene, Isa::automatic);
  const Transport transport(tracer, settings);
  const Parts parts(transport, nullptr);
  Json all{{"scene", scene.name},
           {"field_directions", settings.fieldDirections},
           {"field_distances", settings.fieldDistances}};
  all.update(sizesOf(scene, parts));
  all.update(parts.json());
  all.update(photonsOf(tracer, settings));
  if (!edit.empty()) {
    const Script script = readScript(edit, scene);
    const SceneEdit done = script.at(script.seconds, scene, settings.camera).edit;
    const Scene changed = edited(scene, done);
    const Tracer tracerAfter(tracer, changed, movedInstances(scene, done));
    const Transport after(tracerAfter, settings, &transport);
    all["edit"] = Parts(after, &parts).json();
  }
  return writeOutput(all.dump() + "\n"), 0;
}

}  // namespace
}  // namespace ninefold

int main(int argc, char** argv) {
  return ninefold::runProgram(ninefold::kProgram, [&] { return ninefold::run(argc, argv); });
}
