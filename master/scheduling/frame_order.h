// frame_order.h: a frame that somebody wants: its key, and the job that it is of. Plain value.
//
// A job is one version of the settings (camera and size included), of the form of results, and of
// the scene. All are announced to the clients when the first frame opens that shows them. Job
// versions and frame numbers only grow; a frame's job is never older than that of the frame before.
#pragma once

#include "common/scene/edit.h"
#include "common/scene/settings.h"
#include "proto/messages.h"

namespace ninefold {

struct FrameOrder {
  FrameKey key;
  uint32_t job = 1;
  Settings settings;
  uint32_t scene = 0;   // version of the scene
  SceneEdit edit;       // what is different from the version before
  bool moving = false;  // as in msg::Edit
  bool urgent = false;  // somebody waits for it (FrameKind)
  uint8_t extraMask = 0;
  Delivery delivery;          // of the job, too
  float neighbourWeight = 1;  // of the filter, in [0, 1]; less than 1 only where clients filter

  TileGrid grid() const { return {settings.width, settings.height, settings.interleave}; }
};

}  // namespace ninefold
