// replay_line.h: the command that makes a picture again, for whoever looks for what went wrong in
// it.
//
// The scene's file is named SCENE: clients do not know it. Headless frames are numbered from 0. The
// flags are those of ninefold-master; jitter and compensation are left as the presets have them.
// Threads: pure.
#pragma once

#include <string>

#include "common/scene/scene.h"
#include "common/scene/settings.h"

namespace ninefold {

// Up to and with this frame.
std::string replayLine(const Scene& scene, const Settings& settings, uint32_t frame);

}  // namespace ninefold
