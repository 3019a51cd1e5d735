// task.h: what a client is asked for, and from where it is seen.
//
// Threads: plain data.
#pragma once

#include <optional>

#include "common/gi/light/transport.h"
#include "common/sampling/interleave.h"

namespace ninefold {

// The pixels of one phase in one tile of one frame, and the extra planes wanted.
struct Task {
  FrameKey frame;
  int tile = 0;
  int phase = 0;
  uint8_t extraMask = 0;
  std::optional<TaskRect> rect = {};  // other pixels of the phase than the tile's own
};

// Whose pixels they are: the settings of the Transport may be those of another view.
struct View {
  Camera camera;
  int width, height;
  // The solids that the eye is inside of. Each ray of an orthographic camera starts elsewhere: what
  // it starts in is found out where it leaves it (Shader::before).
  MediumStack eyeMedia;
};

// The view of these settings. An eye exactly on a surface is moved off: at no distance it would see
// nothing else.
View viewOf(const Transport& transport, const Settings& settings);

}  // namespace ninefold
