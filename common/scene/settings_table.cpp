#include "common/scene/settings_table.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace ninefold {
namespace {

struct Anything {
  template <typename T>
  operator T() const;  // never called
};

// How many members an aggregate has: as many as it takes values.
template <typename T, typename... Values>
constexpr size_t membersOf() {
  if constexpr (requires { T{Values{}..., Anything{}}; })
    return membersOf<T, Values..., Anything>();
  else
    return sizeof...(Values);
}
static_assert(membersOf<Settings>() == std::tuple_size_v<decltype(kSettings)>,
              "each member of Settings needs its row in kSettings, and each row a member");

// Ranges are of real numbers; their ends become floats as values do.
template <typename T, typename Row>
void checkNumber(const char* what, T value, const Row& row) {
  if (value >= static_cast<T>(row.low) && value <= static_cast<T>(row.high)) return;
  const char* space = row.unit[0] == '\0' ? "" : " ";
  fail("{} is {}, must be {} to {}{}{}", what, value, row.low, row.high, space, row.unit);
}

void checkFinite(const char* what, Vec3 v) {
  if (!isFinite(v)) fail("{} is not finite", what);
}

}  // namespace

std::pair<int, int> parseSize(std::string_view text) {
  constexpr Setting<int> side = settingOf(&Settings::width);
  return parsePair("size", text, static_cast<int>(side.low), static_cast<int>(side.high));
}

std::span<const char* const> namesOf(Method) {
  static const std::vector<const char*> names = [] {
    std::vector<const char*> all;
    for (const MethodFacts& facts : methodTable()) all.push_back(facts.name);
    return all;
  }();
  return names;
}

std::span<const char* const> namesOf(Caustics) {
  static constexpr std::array kNames{"off", "direct", "all"};
  return kNames;
}

std::span<const char* const> namesOf(ElementRule) {
  static constexpr std::array kNames{"linear", "buckets"};
  return kNames;
}

std::span<const char* const> namesOf(FieldDirect) {
  static constexpr std::array kNames{"vpls", "field"};
  return kNames;
}

std::span<const char* const> namesOf(FieldWeights) {
  static constexpr std::array kNames{"measure", "alike"};
  return kNames;
}

std::span<const char* const> namesOf(PartitionRule) {
  static constexpr std::array kNames{"balance", "equal"};
  return kNames;
}

std::span<const char* const> namesOf(MapDistribution) {
  static constexpr std::array kNames{"random", "frame", "turn", "nets"};
  return kNames;
}

std::span<const char* const> namesOf(MapIndex) {
  static constexpr std::array kNames{"grid", "tree"};
  return kNames;
}

std::span<const char* const> namesOf(MapEstimate) {
  static constexpr std::array kNames{"pixels", "vertices"};
  return kNames;
}

std::span<const char* const> namesOf(MapDirect) {
  static constexpr std::array kNames{"off", "on"};
  return kNames;
}

std::span<const char* const> namesOf(Randomization) {
  static constexpr std::array kNames{"xor", "owen", "random"};
  return kNames;
}

// As few digits as give the same float again.
std::string textOf(float value) { return fmt::format("{}", value); }

std::string textOf(Interleave value) { return fmt::format("{}x{}", value.n, value.m); }

std::string textOf(Radiance value) { return fmt::format("{},{},{}", value.x, value.y, value.z); }

void checkRange(const Setting<int>& row, int value) { checkNumber(row.name, value, row); }

void checkRange(const Setting<float>& row, float value) { checkNumber(row.name, value, row); }

void checkRange(const Setting<Interleave>& row, Interleave value) {
  checkNumber("interleave columns", value.n, row);
  checkNumber("interleave rows", value.m, row);
}

void checkRange(const Setting<Radiance>& row, Radiance value) {
  for (int i = 0; i < 3; ++i) checkNumber(row.name, value[i], row);
}

void checkRange(const Setting<Camera>&, const Camera& camera) {
  checkFinite("camera eye", camera.eye);
  checkFinite("camera forward", camera.forward);
  checkFinite("camera up", camera.up);
  if (std::abs(glm::length(camera.forward) - 1) > 1e-3f)
    fail("camera forward is not a unit vector");
  const float upLength = glm::length(camera.up);
  if (!(glm::length(glm::cross(camera.forward, camera.up)) > 1e-6f * upLength))
    fail("camera up is parallel to forward, or zero");
  if (!(camera.verticalFov > 0 && camera.verticalFov < kPi))
    fail("camera field of view is {}, must be between 0 and pi", camera.verticalFov);
  if (!(camera.orthographicHeight >= 0 && camera.orthographicHeight <= kLargestFilm))
    fail("orthographic height of the camera is {}, must be between 0 and {:g}",
         camera.orthographicHeight, kLargestFilm);
}

}  // namespace ninefold
