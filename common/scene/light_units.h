// light_units.h: in which units a glTF file's punctual lamps are, and what they become.
//
//   radiometric   1 cd = 1 W/sr, 1 lx = 1 W/m^2
//   photometric   683 cd = 1 W/sr, 683 lx = 1 W/m^2
//
// 683 lm/W is the factor by which exporters turn watts into lumens. So photometric lamps agree with
// the emission that the same exporters write in W/(m^2 sr). KHR_lights_punctual asks for candela
// and lux, but many files hold watts. `auto` decides by asset.generator and the brightest lamp:
//
//   Khronos glTF Blender I/O v3.4 or later, brightest lamp 100 or more    photometric
//   the same with fainter lamps alone: its "unitless" mode                radiometric
//   anything else                                                         radiometric
//
// A lamp of 100 cd has 1.8 W if it is in candela, and 1,257 W if it is not.
//
// Source:  exporters' own sources, docs/light-units.md.
// Proved:  tests/scene/light_units_test.cpp.   Threads: pure.   Errors: none.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace ninefold {

enum class LightUnits : uint8_t { automatic, radiometric, photometric };
inline constexpr std::array kLightUnitsNames = {"auto", "radiometric", "photometric"};

inline constexpr double kLumensPerWatt = 683;

struct LightReading {
  bool isPhotometric = false;
  std::string line;         // what was taken, and how to have the other
  bool isDoubtful = false;  // the file is known to be neither
};

// brightest: the largest component of a lamp in the file [cd or lx].
LightReading readingOf(LightUnits asked, std::string_view generator, double brightest);

}  // namespace ninefold
