// preset.h: sets of settings that go by one name.
//
//   interactive   the defaults of Settings
//   final         more of everything
//   paper         Wald et al. 2002: 22 VPLs, 1000 photons from the lights, its sampling
//   segovia       Segovia et al. 2006: one set of 30 VPLs, about a tenth of the candidates. Half of
//                 them come from the lamps, half from the camera; each brings half of the light
//                 (gi/bidirectional/estimated_density.h). Worth, bound, compensation and photons
//                 are ours: the published form has none of the last three.
//   dmitriev      Dmitriev et al. 2002: 1,152,000 photons, bucketed in mesh elements. Pilots, order
//                 and direct light are ours.
//   ren           Ren et al. 2005: 76 slopes and 127 distances, direct light of area lamps by the
//                 lines, all of which count alike. Light lies in mesh elements, not in Gaussians of
//                 a texture, and lines near the vertical are there: those are ours.
//
// Threads: pure functions.
#pragma once

#include <array>
#include <cstdint>

#include "common/scene/settings.h"

namespace ninefold {

enum class Preset : uint8_t { interactive, final, paper, segovia, dmitriev, ren };
inline constexpr std::array kPresetNames{"interactive", "final",    "paper",
                                         "segovia",     "dmitriev", "ren"};

inline const char* nameOf(Preset preset) { return kPresetNames[static_cast<size_t>(preset)]; }

Settings settingsOf(Preset preset);

}  // namespace ninefold
