// settings_table.h: all settings, once: for each its name, member, range, unit, help, the parts of
// light that it is about, and its slider. Flags, their help and variables, the wire, ranges, JSON,
// the panel and replay lines visit this table. A new setting is a member of Settings and a row
// here.
//
//   type of the member   range            flag, JSON                      wire
//   int, float           low to high      a number                        a number
//   uint64_t, bool       all values       a number; true, false           a number
//   an enum              namesOf it       its name                        its number
//   Interleave           low to high      NxM; [n, m]                     two numbers
//   Radiance             low to high      none or R,G,B; [r, g, b]        three numbers
//   Camera               its own rules    by the scene; an object         a message of its own
//
// Threads: constant data.   Errors: checkRange throws Error naming what is out of range.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include "common/base/command_line.h"
#include "common/scene/methods.h"
#include "common/scene/settings.h"

namespace ninefold {

// A slider, menu or box in the panel; none without a label.
struct Slider {
  const char* label = nullptr;
  double low = 0, high = 0;  // what can be reached without typing
  const char* format = nullptr;
  bool isLogarithmic = false;
};

template <typename T>
struct Setting {
  const char* name;  // on the wire, in messages and as a flag; JSON has _ for -
  T Settings::*member;
  double low = 0, high = 0;  // of each number
  const char* unit = "";
  const char* value = nullptr;  // what stands for it in the help; null: no flag of that name
      // {0} and {1} are low and high, and the names of methods. The default is added at the end.
  const char* help = "";
  uint8_t parts = 0;  // LightParts that it is about; 0: it is about any light
  Slider slider = {};

  bool isUsedBy(Method method) const { return parts == 0 || (factsOf(method).parts & parts) != 0; }
};

inline constexpr std::tuple kSettings{
    Setting<Method>{.name = "method",
                    .member = &Settings::method,
                    .value = "NAME",
                    .help = "how light is computed: {0}",
                    .slider = {"method"}},
    Setting<int>{
        .name = "width", .member = &Settings::width, .low = 1, .high = 16384, .unit = "pixels"},
    Setting<int>{
        .name = "height", .member = &Settings::height, .low = 1, .high = 16384, .unit = "pixels"},
    Setting<Camera>{.name = "camera", .member = &Settings::camera},
    Setting<Interleave>{.name = "interleave",
                        .member = &Settings::interleave,
                        .low = 1,
                        .high = 16,
                        .value = "NxM",
                        .help = "light sets side by side, each {0} to {1}",
                        .slider = {"light sets n x n", 1, 5}},
    // Of no light part: with 0 the path tracer leaves direct light out, too.
    Setting<int>{.name = "direct-vpls",
                 .member = &Settings::directVpls,
                 .low = 0,
                 .high = 65536,
                 .value = "N",
                 .help = "virtual lights on the lights, per set, {0} to {1}",
                 .slider = {"direct VPLs", 0, 64}},
    Setting<int>{.name = "indirect-vpls",
                 .member = &Settings::indirectVpls,
                 .low = 0,
                 .high = 65536,
                 .value = "N",
                 .help = "virtual lights that light has bounced to, mean per set, {0} to {1}",
                 .parts = kIndirectVpls,
                 .slider = {"indirect VPLs", 0, 256}},
    Setting<int>{.name = "photons",
                 .member = &Settings::photons,
                 .low = 0,
                 .high = 16777216,
                 .value = "N",
                 .help = "caustic photons per set, {0} to {1}",
                 .parts = kCausticPhotons,
                 .slider = {"photons", 0, 20000}},
    Setting<int>{.name = "resampling",
                 .member = &Settings::resampling,
                 .low = 1,
                 .high = 1000,
                 .value = "R",
                 .help = "candidates for each virtual light that is kept, {0} to {1}; few of them "
                         "for small pictures. At rest a fifth of them, and half of the "
                         "camera points, where a look at the view says that it does as well",
                 .parts = kReverseVpls,
                 .slider = {"candidates", 1, 50}},
    Setting<int>{.name = "camera-points",
                 .member = &Settings::cameraPoints,
                 .low = 1,
                 .high = 4096,
                 .value = "M",
                 .help = "points of the picture that choose virtual lights, per set, {0} to {1}",
                 .parts = kReverseVpls,
                 .slider = {"camera points", 1, 1024}},
    Setting<PartitionRule>{
        .name = "partition",
        .member = &Settings::partition,
        .value = "balance|equal",
        .help = "who brings light that paths of the lamps and of the camera both find: the one "
                "that finds it more often, or each one half, as published",
        .parts = kReverseVpls},
    // No sliders for these two: the one must divide the other (settings_check.h).
    Setting<int>{.name = "map-photons",
                 .member = &Settings::mapPhotons,
                 .low = 1,
                 .high = 4194304,
                 .value = "N",
                 .help = "photon paths that the pool keeps, {0} to {1}",
                 .parts = kMapPhotons},
    Setting<int>{.name = "map-photons-per-frame",
                 .member = &Settings::mapPerFrame,
                 .low = 1,
                 .high = 65536,
                 .value = "N",
                 .help = "photon paths shot anew at a time, the oldest first; divides the pool",
                 .parts = kMapPhotons},
    Setting<int>{.name = "map-nearest",
                 .member = &Settings::mapNearest,
                 .low = 2,
                 .high = 65536,
                 .value = "N",
                 .help = "photons that tell the light at a point, {0} to {1}",
                 .parts = kMapPhotons,
                 .slider = {"nearest", 10, 500}},
    Setting<float>{.name = "map-distance",
                   .member = &Settings::mapDistance,
                   .low = 1e-6,
                   .high = 2,
                   .unit = "R",
                   .value = "F",
                   .help = "how far away they may be as a fraction of R, up to {1}",
                   .parts = kMapPhotons,
                   .slider = {"not beyond", 0.01, 1, "%.3f R"}},
    Setting<MapDirect>{.name = "map-direct",
                       .member = &Settings::mapDirect,
                       .value = "off|on",
                       .help = "light straight from lamps by photons, too; off: by virtual lights",
                       .parts = kMapPhotons,
                       .slider = {"direct light by photons"}},
    Setting<MapDistribution>{
        .name = "map-distribution",
        .member = &Settings::mapDistribution,
        .value = "random|frame|turn|nets",
        .help = "how photons leave the lamps: by chance; alike each frame; alike each turn of the "
                "pool; the same, each frame's evenly spread",
        .parts = kMapPhotons,
        .slider = {"distribution"}},
    Setting<MapIndex>{.name = "map-index",
                      .member = &Settings::mapIndex,
                      .value = "grid|tree",
                      .help = "how photons near a point are found; the picture is the same",
                      .parts = kMapPhotons},
    // No sliders for these three: they must fit together (settings_check.h).
    Setting<int>{.name = "photon-pool",
                 .member = &Settings::photonPool,
                 .low = 1,
                 .high = 4194304,
                 .value = "N",
                 .help = "photons whose light mesh elements keep, {0} to {1}; a multiple of groups "
                         "times pilot ratio",
                 .parts = kElementPhotons},
    Setting<int>{.name = "photon-groups",
                 .member = &Settings::photonGroups,
                 .low = 1,
                 .high = 20160,
                 .value = "N",
                 .help = "groups of almost alike photons, {0} to {1}: a product of 2, 3, 5 and 7",
                 .parts = kElementPhotons},
    Setting<int>{.name = "pilot-ratio",
                 .member = &Settings::pilotRatio,
                 .low = 2,
                 .high = 4096,
                 .value = "R",
                 .help = "one of so many photons, {0} to {1}, looks for what an edit concerns",
                 .parts = kElementPhotons},
    Setting<float>{
        .name = "minor-lamps",
        .member = &Settings::minorLamps,
        .low = 0,
        .high = 1,
        .value = "F",
        .help = "the faintest lamps, up to this share of all power, light by photons directly, "
                "too: shadows as soft as elements; 0 = none",
        .parts = kElementPhotons,
        .slider = {"minor lamps", 0, 1, "%.2f of all power"}},
    Setting<float>{.name = "element-size",
                   .member = &Settings::elementSize,
                   .low = 1e-4,
                   .high = 2,
                   .unit = "R",
                   .value = "F",
                   .help = "side of a mesh element as a fraction of R, above 0, up to {1}",
                   .parts = kElementPhotons | kFieldPhotons,
                   .slider = {"element size", 0.005, 0.5, "%.3f R", true}},
    Setting<ElementRule>{.name = "element-rule",
                         .member = &Settings::elementRule,
                         .value = "linear|buckets",
                         .help = "light between the corners of elements: by degrees, or that of "
                                 "the nearest one, as published",
                         .parts = kElementPhotons | kFieldPhotons,
                         .slider = {"light between elements"}},
    // No sliders for these two: they must fit together, and the scene may be too large for them.
    Setting<int>{.name = "field-directions",
                 .member = &Settings::fieldDirections,
                 .low = 2,
                 .high = 128,
                 .value = "N",
                 .help = "slopes of the field's lines, {0} to {1}, horizontal and vertical; as "
                         "published 76",
                 .parts = kFieldPhotons},
    Setting<int>{.name = "field-distances",
                 .member = &Settings::fieldDistances,
                 .low = 2,
                 .high = 255,
                 .value = "M",
                 .help = "lines of each slope side by side, {0} to {1}, without a common divisor "
                         "with the slopes; as published 127",
                 .parts = kFieldPhotons},
    Setting<int>{.name = "field-photons",
                 .member = &Settings::fieldPhotons,
                 .low = 1,
                 .high = 4194304,
                 .value = "N",
                 .help = "photons along the field's lines whose light mesh elements keep, {0} to "
                         "{1}",
                 .parts = kFieldPhotons},
    Setting<FieldDirect>{.name = "field-direct",
                         .member = &Settings::fieldDirect,
                         .value = "vpls|field",
                         .help = "light straight from area lamps by virtual lights, or by the "
                                 "field's lines, as published",
                         .parts = kFieldPhotons,
                         .slider = {"direct light"}},
    Setting<FieldWeights>{.name = "field-weights",
                          .member = &Settings::fieldWeights,
                          .value = "measure|alike",
                          .help = "what a line counts that joins a point and a lamp: as much light "
                                  "as it stands for, or the same as any other, as published",
                          .parts = kFieldPhotons},
    Setting<int>{.name = "max-field-memory",
                 .member = &Settings::maxFieldMemory,
                 .low = 1,
                 .high = 1048576,
                 .unit = "MiB",
                 .value = "N",
                 .help = "of a client for its field; what needs more is refused",
                 .parts = kFieldPhotons},
    // No sliders for these two: the scene may be too large for them (settings_check.h).
    Setting<MapEstimate>{
        .name = "map-estimate",
        .member = &Settings::mapEstimate,
        .value = "pixels|vertices",
        .help = "where photons tell the light: at what each pixel sees, or at the vertices of a "
                "finer mesh, and between them in proportion",
        .parts = kMapPhotons},
    Setting<int>{.name = "map-subdivision",
                 .member = &Settings::mapSubdivision,
                 .low = 0,
                 .high = 6,
                 .value = "N",
                 .help = "levels of that mesh, {0} to {1}: each makes four of a triangle",
                 .parts = kMapPhotons},
    Setting<int>{.name = "path-length",
                 .member = &Settings::pathLength,
                 .low = 0,
                 .high = 1 << 20,
                 .value = "N",
                 .help = "diffuse vertices of a path at most, 0 = no limit",
                 .slider = {"path length", 0, 16, "%d (0 = no limit)"}},
    Setting<int>{.name = "specular-depth",
                 .member = &Settings::specularDepth,
                 .low = 1,
                 .high = 1024,
                 .value = "N",
                 .help = "mirrors and glass in a row at most, {0} to {1}"},
    Setting<float>{.name = "bound",
                   .member = &Settings::bound,
                   .low = 1e-6,
                   .high = 1e12,
                   .value = "C",
                   .help = "bound of the geometry term b = C/R^2, above 0",
                   .parts = kVpls,
                   .slider = {"bound", 1, 1000, "%.0f", true}},
    Setting<float>{.name = "vpl-roulette",
                   .member = &Settings::vplRoulette,
                   .low = 0,
                   .high = 1000,
                   .value = "F",
                   .help = "skip virtual lights that add less than F times the mean, at random; 0 "
                           "= none",
                   .parts = kVpls},
    Setting<float>{.name = "photon-radius",
                   .member = &Settings::photonRadius,
                   .low = 1e-6,
                   .high = 1,
                   .unit = "R",
                   .value = "F",
                   .help = "first photon radius as a fraction of R, up to {1}",
                   .parts = kCausticPhotons,
                   .slider = {"photon radius", 0.001, 0.1, "%.3f R"}},
    Setting<Caustics>{.name = "caustics",
                      .member = &Settings::caustics,
                      .value = "off|direct|all",
                      .help = "photons from nowhere, from the lights, or from lit surfaces too",
                      .slider = {"caustics"}},
    Setting<Radiance>{.name = "environment",
                      .member = &Settings::environment,
                      .low = 0,
                      .high = 1e6,
                      .unit = "W/(m^2 sr)",
                      .value = "none|COLOR|FILE",
                      .help = "light from outside: R,G,B or one number [W/(m^2 sr)], or a picture "
                              "of all directions, FILE.hdr|.exr[:ROTATION[:STRENGTH]] (default "
                              "none; white 1, with a warning, if the scene has no light at all)"},
    Setting<Randomization>{
        .name = "randomization",
        .member = &Settings::randomization,
        .value = "owen|xor|random",
        .help = "of the sample points: nested scrambling or exclusive-or of a Sobol' sequence, or "
                "none of it: pseudo-random points"},
    Setting<uint64_t>{
        .name = "seed", .member = &Settings::seed, .value = "N", .help = "of all randomness"},
    Setting<bool>{.name = "jitter", .member = &Settings::jitter},
    Setting<bool>{.name = "compensate",
                  .member = &Settings::compensate,
                  .parts = kVpls,
                  .slider = {"compensate the bound"}},
};

// Calls visit(row) for each setting.
template <typename Visit>
void forEachSetting(const Visit& visit) {
  std::apply([&](const auto&... rows) { (visit(rows), ...); }, kSettings);
}

// The row of a member.
template <typename T>
constexpr Setting<T> settingOf(T Settings::*member) {
  Setting<T> found{};
  const auto look = [&](const auto& row) {
    if constexpr (std::is_same_v<std::decay_t<decltype(row)>, Setting<T>>)
      if (row.member == member) found = row;
  };
  std::apply([&](const auto&... rows) { (look(rows), ...); }, kSettings);
  return found;
}

// "WxH" of --size to width and height, in the ranges of their rows. Throws UsageError.
std::pair<int, int> parseSize(std::string_view text);

// Names of an enum's values, in their order.
std::span<const char* const> namesOf(Method);
std::span<const char* const> namesOf(Caustics);
std::span<const char* const> namesOf(ElementRule);
std::span<const char* const> namesOf(FieldDirect);
std::span<const char* const> namesOf(FieldWeights);
std::span<const char* const> namesOf(PartitionRule);
std::span<const char* const> namesOf(MapDistribution);
std::span<const char* const> namesOf(MapIndex);
std::span<const char* const> namesOf(MapDirect);
std::span<const char* const> namesOf(MapEstimate);
std::span<const char* const> namesOf(Randomization);

// One word, as a flag takes it.
inline std::string textOf(int value) { return std::to_string(value); }
inline std::string textOf(uint64_t value) { return std::to_string(value); }
std::string textOf(float value);
std::string textOf(Interleave value);
std::string textOf(Radiance value);
template <typename Enum>
requires std::is_enum_v<Enum> std::string textOf(Enum value) {
  return namesOf(value)[static_cast<size_t>(value)];
}

// Throws Error if a value is out of its row's range. An enum is checked as its number.
void checkRange(const Setting<int>& row, int value);
void checkRange(const Setting<float>& row, float value);
void checkRange(const Setting<Interleave>& row, Interleave value);
void checkRange(const Setting<Radiance>& row, Radiance value);
void checkRange(const Setting<Camera>& row, const Camera& value);
template <typename Enum>
requires std::is_enum_v<Enum>
void checkRange(const Setting<Enum>& row, uint64_t number) {
  if (const uint64_t last = namesOf(Enum{}).size() - 1; number > last)
    fail("{} is {}, must be 0 to {}", row.name, number, last);
}

}  // namespace ninefold
