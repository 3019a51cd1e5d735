// The table, and what follows from it. Rays n of a task and its light set: p pixels of the task,
// v VPLs and f photons of the set:
//
//     n = p (2 + v) + v + 4 f        instant radiosity: a photon meets four surfaces
//     n = the same + 18 r c + M v    bidirectional: r c candidates, c = direct + 2 indirect VPLs,
//                                    each judged by 16 camera points; those kept see all M
//     n = 64 p                       path tracing: 32 vertices, each with a ray to a light
//     n = p (11 + d) + d + 4 f       photon map: d direct VPLs, and eight rays that tell how much
//                                    surface is around; a unit of its state: 4 rays a path
//     n = p (3 + d) + d + 4 f        selective photons; a unit of its state: 4 rays a photon
//     n = the same                   intersection field; a unit of its state: 2 rays a photon
//     n = as bidirectional           auto, at most; a unit of its state: a set, and some pixels, by
//                                    both of the methods that it tries
#include "common/scene/methods.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "common/image/layers.h"
#include "common/scene/method_trial.h"

namespace ninefold {
namespace {

double radiosityRays(const Settings& s, double pixels) {
  const double vpls = s.directVpls + s.indirectVpls;
  return pixels * (2 + vpls) + vpls + 4.0 * s.photons;
}

double bidirectionalRays(const Settings& s, double pixels) {
  const double candidates = s.resampling * (s.directVpls + 2.0 * s.indirectVpls);
  return radiosityRays(s, pixels) + 18 * candidates +
         1.0 * s.cameraPoints * (s.directVpls + s.indirectVpls);
}

double pathRays(const Settings&, double pixels) { return 64 * pixels; }

double mapRays(const Settings& s, double pixels) {
  const double direct = s.mapDirect == MapDirect::on ? 0 : s.directVpls;
  return pixels * (11 + direct) + direct + 4.0 * s.photons + 64;
}

uint32_t partsOfMap(const Settings& s) {
  return static_cast<uint32_t>(std::max(s.mapPhotons / s.mapPerFrame, 1));
}

// What the pool's photons do not go by is taken from the other; all else must be the same.
bool haveSameMap(const Settings& before, const Settings& after) {
  Settings a = before;
  a.width = after.width, a.height = after.height, a.camera = after.camera;
  a.interleave = after.interleave, a.jitter = after.jitter;
  a.indirectVpls = after.indirectVpls, a.photons = after.photons, a.caustics = after.caustics;
  a.photonRadius = after.photonRadius, a.bound = after.bound, a.compensate = after.compensate;
  a.vplRoulette = after.vplRoulette, a.resampling = after.resampling;
  a.cameraPoints = after.cameraPoints, a.partition = after.partition;
  a.mapNearest = after.mapNearest, a.mapDistance = after.mapDistance, a.mapIndex = after.mapIndex;
  a.mapEstimate = after.mapEstimate, a.mapSubdivision = after.mapSubdivision;
  const bool hadLamps = before.directVpls > 0, hasLamps = after.directVpls > 0;
  if (hadLamps == hasLamps || before.mapDirect == MapDirect::off) a.directVpls = after.directVpls;
  return a == after;
}

constexpr StateFacts kMapState{
    .unitsOfAll = partsOfMap,
    .unitsInMotion = [](const Settings&) { return 1u; },
    .rays = [](const Settings& s) { return 4.0 * s.mapPerFrame; },
    .beginsAnew = true,
    .isPaced = false,
    .isKept = haveSameMap,
};

double selectiveRays(const Settings& s, double pixels) {
  return pixels * (3 + s.directVpls) + s.directVpls + 4.0 * s.photons;
}

// Photons that a step in motion traces, about: as long as a frame on a few cores.
constexpr uint32_t kPhotonsInMotion = 1 << 14;

// Rows of photons: groups, and parts of the pilots that are about as large.
uint32_t rowsOfAll(const Settings& s) {
  return static_cast<uint32_t>(s.photonGroups + (s.photonGroups + s.pilotRatio - 1) / s.pilotRatio);
}

uint32_t rowsInMotion(const Settings& s) {
  const int photonsOfEach = std::max(s.photonPool / s.photonGroups, 1);
  return std::clamp(kPhotonsInMotion / static_cast<uint32_t>(photonsOfEach), 1u, rowsOfAll(s));
}

// Photons go by few settings; what elements make of them is no part of the state.
bool haveSameGroups(const Settings& before, const Settings& after) {
  return before.method == after.method && before.photonPool == after.photonPool &&
         before.photonGroups == after.photonGroups && before.pilotRatio == after.pilotRatio &&
         before.seed == after.seed && before.pathLength == after.pathLength &&
         before.specularDepth == after.specularDepth && before.environment == after.environment &&
         before.minorLamps == after.minorLamps &&
         (before.minorLamps == 0 || (before.directVpls > 0) == (after.directVpls > 0));
}

// Clients keep the paths of so many.
constexpr int kMostKeptPhotons = 1 << 19;

constexpr StateFacts kSelectiveState{
    .unitsOfAll = rowsOfAll,
    .unitsInMotion = rowsInMotion,
    .rays = [](const Settings& s) { return 4.0 * s.photonPool / s.photonGroups; },
    .beginsAnew = true,
    .isPaced = true,
    .isKept = haveSameGroups,
    .remembers = [](const Settings& s) { return s.photonPool <= kMostKeptPhotons; },
};

// Lines stand for rays, and take about half as long.
bool haveSameLines(const Settings& before, const Settings& after) {
  return before.method == after.method && before.fieldDirections == after.fieldDirections &&
         before.fieldDistances == after.fieldDistances &&
         before.fieldPhotons == after.fieldPhotons && before.elementSize == after.elementSize &&
         before.seed == after.seed && before.pathLength == after.pathLength &&
         before.specularDepth == after.specularDepth && before.environment == after.environment;
}

constexpr StateFacts kFieldState{
    .unitsOfAll = fieldRows,
    .unitsInMotion =
        [](const Settings& s) { return std::min(kPhotonsInMotion / kPhotonsOfRow, fieldRows(s)); },
    .rays = [](const Settings&) { return 2.0 * kPhotonsOfRow; },
    .beginsAnew = true,
    .isPaced = true,
    .isKept = haveSameLines,
};

double trialRays(const Settings& s) {
  return radiosityRays(s, kTrialPixels) + bidirectionalRays(s, kTrialPixels);
}

// Both methods find all light under all settings: what was chosen is never wrong.
constexpr StateFacts kTrial{
    .unitsOfAll = [](const Settings&) { return kTrialUnits; },
    .unitsInMotion = nullptr,
    .rays = trialRays,
    .beginsAnew = true,
    .isPaced = false,
    .isKept = [](const Settings&, const Settings&) { return true; },
    .describe = describeTrial,
};

#ifdef NINEFOLD_TEST_METHODS
constexpr size_t kTestMethods = 1;
constexpr StateFacts kStateCheckSteps{
    .unitsOfAll = [](const Settings&) { return 6u; },
    .unitsInMotion = [](const Settings&) { return 2u; },
    .rays = [](const Settings&) { return 1.0; },
    .beginsAnew = false,
    .isPaced = false,
    .isKept = [](const Settings& a, const Settings& b) { return a.seed == b.seed; }};
#else
constexpr size_t kTestMethods = 0;
#endif

// Those for tests alone at the end.
constexpr std::array kTable{
    MethodFacts{.method = Method::instantRadiosity,
                .name = "instant-radiosity",
                .title = "instant radiosity",
                .help = "",
                .parts = kVpls | kCausticPhotons,
                .isUnfiltered = false,
                .lightNeedsView = false,
                .freeSets = false,
                .missesPunctualCaustics = false,
                .rays = radiosityRays},
    MethodFacts{.method = Method::pathTrace,
                .name = "path-trace",
                .title = "path tracing",
                .help = "the slow, unbiased reference",
                .parts = 0,
                .isUnfiltered = true,
                .lightNeedsView = false,
                .freeSets = true,
                .missesPunctualCaustics = true,
                .rays = pathRays},
    MethodFacts{.method = Method::bidirectional,
                .name = "bidirectional",
                .title = "bidirectional instant radiosity",
                .help = "also finds light that comes round corners",
                .parts = kVpls | kCausticPhotons | kReverseVpls,
                .isUnfiltered = false,
                .lightNeedsView = true,
                .freeSets = false,
                .missesPunctualCaustics = false,
                .rays = bidirectionalRays},
    MethodFacts{.method = Method::photonMap,
                .name = "photon-map",
                .title = "photon map",
                .help = "a pool of photons that is renewed bit by bit; blurs bounced light",
                .parts = kDirectVpls | kCausticPhotons | kMapPhotons,
                .isUnfiltered = false,
                .lightNeedsView = false,
                .freeSets = false,
                .missesPunctualCaustics = false,
                .rays = mapRays,
                .state = &kMapState,
                .bias = "light that has bounced is blurred over as wide as its nearest photons"},
    MethodFacts{.method = Method::selective,
                .name = "selective-photons",
                .title = "selective photons",
                .help = "keeps light in mesh elements and renews first what an edit concerns; "
                        "blurs bounced light",
                .parts = kDirectVpls | kCausticPhotons | kElementPhotons,
                .isUnfiltered = false,
                .lightNeedsView = false,
                .freeSets = false,
                .missesPunctualCaustics = false,
                .rays = selectiveRays,
                .state = &kSelectiveState,
                .bias = "light that has bounced is blurred over as wide as mesh elements are"},
    MethodFacts{.method = Method::automatic,
                .name = "auto",
                .title = "automatic",
                .help = "one of both kinds of instant radiosity, as a short trial tells",
                .parts = kVpls | kCausticPhotons | kReverseVpls,
                .isUnfiltered = false,
                .lightNeedsView = true,
                .freeSets = false,
                .missesPunctualCaustics = false,
                .rays = bidirectionalRays,
                .state = &kTrial,
                .isChoice = true},
    MethodFacts{.method = Method::intersectionField,
                .name = "intersection-field",
                .title = "intersection field",
                .help = "knows where a fixed set of lines meets the scene, and sends photons along "
                        "them; blurs bounced light",
                .parts = kDirectVpls | kCausticPhotons | kFieldPhotons,
                .isUnfiltered = false,
                .lightNeedsView = false,
                .freeSets = false,
                .missesPunctualCaustics = false,
                .rays = selectiveRays,
                .state = &kFieldState,
                .bias = "light that has bounced goes along few lines, and is blurred over as wide "
                        "as mesh elements are"},
#ifdef NINEFOLD_TEST_METHODS
    MethodFacts{.method = Method::stateCheck,
                .name = "state-check",
                .title = "state check",
                .help = "",
                .parts = 0,
                .isUnfiltered = false,
                .lightNeedsView = false,
                .freeSets = true,
                .missesPunctualCaustics = false,
                .rays = pathRays,
                .state = &kStateCheckSteps},
#endif
};

constexpr bool isInOrder() {
  for (size_t i = 0; i < kTable.size(); ++i)
    if (static_cast<size_t>(kTable[i].method) != i) return false;
  return true;
}
static_assert(isInOrder());

}  // namespace

std::span<const MethodFacts> methodTable() { return kTable; }

std::span<const MethodFacts> allMethods() {
  return methodTable().first(kTable.size() - kTestMethods);
}

const MethodFacts& factsOf(Method method) { return kTable.at(static_cast<size_t>(method)); }

uint8_t layerMaskOf(const Needs& needs, Method method) {
  return factsOf(method).isUnfiltered ? kDiffuseBit : needs.layerMask();
}

bool usesPhotons(const Needs& needs, const Settings& settings) {
  return needs.caustics && factsOf(settings.method).has(kCausticPhotons) &&
         settings.caustics != Caustics::off && settings.photons > 0;
}

bool differInViewAlone(const Settings& a, const Settings& b) {
  Settings seenAlike = a;
  seenAlike.camera = b.camera, seenAlike.width = b.width, seenAlike.height = b.height;
  return seenAlike == b;
}

bool haveSameLight(const Settings& a, const Settings& b) {
  return factsOf(a.method).lightNeedsView ? a == b : differInViewAlone(a, b);
}

std::string describeMethods() {
  std::string text;
  for (const MethodFacts& facts : allMethods()) {
    const bool isLast = &facts == &allMethods().back();
    if (&facts != &kTable.front()) text += isLast ? " or " : ", ";
    const std::string note = facts.method == Settings{}.method ? "default" : facts.help;
    text += note.empty() ? std::string(facts.name) : fmt::format("{} ({})", facts.name, note);
  }
  return text;
}

std::vector<std::string> leftOut(const Needs& needs, const Settings& settings) {
  std::vector<std::string> lines;
  const MethodFacts& facts = factsOf(settings.method);
  if (facts.missesPunctualCaustics && needs.punctualLights && needs.smoothSpecular)
    lines.push_back(fmt::format(
        "{} cannot find light that comes from point, spot or directional lights by way of smooth "
        "mirrors, glass or transparent surfaces: it is missing",
        facts.name));
  if (!needs.caustics) return lines;
  const bool noPhotons = facts.has(kCausticPhotons) && settings.photons == 0;
  if (settings.caustics == Caustics::off || noPhotons)
    lines.emplace_back("caustics are off: light by way of mirrors and glass is missing");
  else if (settings.caustics == Caustics::direct)
    lines.emplace_back(
        "caustics are direct: light that lit surfaces send by way of mirrors and glass is missing");
  return lines;
}

}  // namespace ninefold
