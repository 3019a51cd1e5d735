// preset.h: sets of settings that go by one name.
//
//   interactive   the defaults of Settings
//   final         more of everything
//   paper         Wald et al. 2002: 22 VPLs, 1000 photons from the lights, its sampling
//
// Threads: pure functions.
#pragma once

#include <array>
#include <cstdint>

#include "common/scene/settings.h"

namespace ninefold {

enum class Preset : uint8_t { interactive, final, paper };
inline constexpr std::array kPresetNames{"interactive", "final", "paper"};

inline const char* nameOf(Preset preset) { return kPresetNames[static_cast<size_t>(preset)]; }

Settings settingsOf(Preset preset);

}  // namespace ninefold
