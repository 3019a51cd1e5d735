#include "common/scene/light_units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <utility>

namespace ninefold {
namespace {

constexpr double kFaintest = 100;  // [cd or lx] of what counts as candela and lux

using Version = std::pair<int, int>;
constexpr Version kFirstWithModes{3, 4};

// Of Blender's exporter; 0.0 where it does not say. Nothing: another exporter.
std::optional<Version> blenderVersion(std::string_view generator) {
  if (generator.starts_with("Khronos Blender glTF")) return Version{0, 0};  // until 2018
  constexpr std::string_view kName = "Khronos glTF Blender I/O";
  if (!generator.starts_with(kName)) return std::nullopt;
  generator.remove_prefix(kName.size());
  if (generator.starts_with(" v")) generator.remove_prefix(2);
  const char* end = generator.data() + generator.size();
  Version version{0, 0};
  const auto major = std::from_chars(generator.data(), end, version.first);
  if (major.ptr != end && *major.ptr == '.') std::from_chars(major.ptr + 1, end, version.second);
  return version;
}

// A file's own words may hold anything; a message stays short and one line.
std::string shown(std::string_view generator) {
  constexpr size_t kLongest = 60;
  if (generator.empty()) return "the file names no exporter";
  std::string text = "written by " + std::string(generator.substr(0, kLongest));
  std::ranges::replace_if(
      text, [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
  return text;
}

LightReading photometric(const std::string& why) {
  return {true,
          fmt::format("lamps: photometric ({}), {:g} cd are 1 W/sr, {:g} lx are 1 W/m^2; "
                      "--light-units radiometric takes 1 cd as 1 W/sr",
                      why, kLumensPerWatt, kLumensPerWatt),
          false};
}

LightReading radiometric(const std::string& why) {
  return {false,
          fmt::format("lamps: radiometric ({}), 1 cd is 1 W/sr, 1 lx is 1 W/m^2; "
                      "--light-units photometric divides them by {:g} lm/W",
                      why, kLumensPerWatt),
          false};
}

}  // namespace

LightReading readingOf(LightUnits asked, std::string_view generator, double brightest) {
  if (asked == LightUnits::photometric) return photometric("as asked");
  if (asked == LightUnits::radiometric) return radiometric("as asked");
  const std::optional<Version> blender = blenderVersion(generator);
  const std::string by = shown(generator);
  if (!blender) return radiometric(by);
  if (*blender < kFirstWithModes)
    return {false,
            fmt::format("lamps: radiometric ({}), which puts the watts of a whole lamp where "
                        "candela belong: suns are right, points and spots 4 pi times too bright; "
                        "export anew with Blender 3.4 or later",
                        by),
            true};
  if (brightest < kFaintest)
    return radiometric(fmt::format("{}, none reaches {:g} cd or lx, so unitless", by, kFaintest));
  return photometric(by);
}

}  // namespace ninefold
