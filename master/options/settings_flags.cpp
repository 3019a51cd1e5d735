#include "master/options/settings_flags.h"

#include <fmt/format.h>

#include "common/scene/environment_file.h"
#include "common/scene/settings_table.h"
#include "master/options/preset.h"

namespace ninefold {
namespace {

// "(default 4; final 16)"
template <typename T>
std::string defaultOf(const Setting<T>& row) {
  const T usual = Settings{}.*row.member;
  std::string text = "default " + textOf(usual);
  for (const Preset preset :
       {Preset::final, Preset::paper, Preset::segovia, Preset::dmitriev, Preset::ren})
    if (const T value = settingsOf(preset).*row.member; value != usual)
      text += fmt::format("; {} {}", nameOf(preset), textOf(value));
  return "(" + text + ")";
}

template <typename T>
std::string helpOf(const Setting<T>& row) {
  return fmt::format(fmt::runtime(row.help), row.low, row.high) + " " + defaultOf(row);
}

std::string helpOf(const Setting<Method>& row) {
  return fmt::format(fmt::runtime(row.help), describeMethods());
}

// What it is if no flag says so is the scene's.
std::string helpOf(const Setting<Radiance>& row) { return row.help; }

void read(const RawOptions& raw, const Setting<int>& row, int& to) {
  const auto low = static_cast<uint64_t>(row.low), high = static_cast<uint64_t>(row.high);
  if (const auto value = raw.whole(row.name, low, high)) to = static_cast<int>(*value);
}

void read(const RawOptions& raw, const Setting<uint64_t>& row, uint64_t& to) {
  if (const auto text = raw.text(row.name)) to = parseWhole(row.name, *text, 0, UINT64_MAX);
}

void read(const RawOptions& raw, const Setting<float>& row, float& to) {
  if (const auto value = raw.real(row.name, row.low, row.high)) to = static_cast<float>(*value);
}

void read(const RawOptions& raw, const Setting<Interleave>& row, Interleave& to) {
  const auto text = raw.text(row.name);
  if (!text) return;
  const auto [n, m] =
      parsePair(row.name, *text, static_cast<int>(row.low), static_cast<int>(row.high));
  to = {.n = n, .m = m};
}

void read(const RawOptions& raw, const Setting<Radiance>& row, Radiance& to) {
  const auto text = raw.text(row.name);
  if (!text) return;
  if (*text == "none") return void(to = Radiance(0));
  if (namesPicture(*text)) return;  // it is the scene's
  std::vector<double> c = parseNumbers(row.name, *text);
  if (c.size() == 1) c = {c[0], c[0], c[0]};
  if (c.size() != 3) failUsage("--{} {}: write none, R,G,B or one number", row.name, *text);
  for (const double x : c) checkRange(row.name, x, row.low, row.high);
  to = Radiance(static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2]));
}

template <typename Enum>
void read(const RawOptions& raw, const Setting<Enum>& row, Enum& to) {
  if (const auto place = raw.choice(row.name, namesOf(to))) to = static_cast<Enum>(*place);
}

// Calls use(row) for each setting that a flag with one word can say: neither the camera nor a
// switch.
template <typename Use>
void forEachFlag(const Use& use) {
  forEachSetting([&]<typename T>(const Setting<T>& row) {
    if constexpr (!std::is_same_v<T, Camera> && !std::is_same_v<T, bool>)
      if (row.value != nullptr) use(row);
  });
}

}  // namespace

std::vector<SettingFlag> settingFlags() {
  std::vector<SettingFlag> flags;
  forEachFlag([&](const auto& row) { flags.push_back({row.name, row.value, helpOf(row)}); });
  return flags;
}

void readSettings(const RawOptions& raw, Settings& settings) {
  forEachFlag([&](const auto& row) { read(raw, row, settings.*row.member); });
}

}  // namespace ninefold
