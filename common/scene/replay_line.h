// replay_line.h: the command that does one task again, alone, to find what went wrong in it.
//
// SCENE stands for the scene's file, with --light-units if the master had it, and FILE for the
// simpler one for photons or the environment's picture: clients know none of them.
// The flags besides the task are those of ninefold-master. Jitter and compensation are those of the
// preset that is named, if the settings are of one. Cameras that are not the scene's are told as
// numbers, and may differ in their last bits.
// Threads: pure.
#pragma once

#include <string>

#include "common/scene/scene.h"
#include "common/scene/settings.h"

namespace ninefold {

std::string replayLine(const Scene& scene, const Settings& settings, const FrameKey& frame,
                       int tile, int phase);

}  // namespace ninefold
