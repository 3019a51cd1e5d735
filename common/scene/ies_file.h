// ies_file.h: photometric files of IES LM-63 (.ies), as makers of lamps publish them: text to a
// light profile and back.
//
//   [version]                 none: 1986; IESNA91; IESNA:LM-63-1995, -2002; IES:LM-63-2019
//   [keywords and remarks]    any lines
//   TILT=NONE | INCLUDE | file
//   lamps  lumens of a lamp (-1: absolute)  factor m  vertical angles  horizontal angles  type
//   units (1 feet, 2 metres)  width length height of the opening
//   ballast factor b  ballast-lamp factor c  watts
//   vertical angles, horizontal angles [degrees], candela: for each horizontal one all vertical
//
//   I = candela m b c   [cd]   c counts before 1995 only: since then it stands for other things
//
// Type C alone is read. Vertical angles run over 0 to 90 (0 is down), 90 to 180 or 0 to 180, and no
// light goes where they do not. Horizontal ones tell a symmetry:
//
//   0 alone    the same all around
//   0 to 90    each quarter is the mirror image of the next
//   0 to 180   mirrored in the plane of 0 and 180;   90 to 270: of 90 and 270
//   0 to 360   none
//
// TILT has factors for a luminaire that hangs in another way than it was measured. They are checked
// and not applied. The opening and the watts play no part: the light comes from a point.
//
// Numbers stand between blanks, commas or line ends, on lines of any length.
//
// Source:  IESNA LM-63-1986, -1991, -1995, -2002; what 2019 changed: EXT_lights_ies of glTF.
// Proved:  tests/scene/ies_file_test.cpp, tests/fuzz/scene_ies.cpp.
// Threads: pure.   Errors: throws Error with the line and what to do.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "common/scene/light_profile.h"

namespace ninefold {

// What a file may claim. Goniometers do not measure as many.
inline constexpr size_t kMaxIesAngles = 3601;
inline constexpr size_t kMaxIesValues = 1 << 20;  // once symmetries are written out
inline constexpr uint64_t kMaxIesBytes = 16 << 20;

struct IesFile {
  LightProfile profile;
  float peak = 0;                    // the largest I [cd]
  double lumens = 0;                 // of the candela times m: with the ballast of the measurement
  std::optional<double> lampLumens;  // of all lamps together, bare; none: absolute photometry
  bool tilts = false;                // TILT is not NONE
};

IesFile readIes(std::string_view text);

// A file with candela f, which readIes gives back to the last bit.
std::string iesText(const LightProfile& profile);

}  // namespace ninefold
