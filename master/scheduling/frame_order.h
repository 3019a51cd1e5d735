// frame_order.h: a frame, or a step of a method's state, that somebody wants: its key, and the job
// that it is of. Plain values.
//
// A job is one version of the settings (camera and size included), of the form of results, and of
// the scene. All are announced to the clients when the first frame or step opens that is of it. Job
// versions and numbers only grow; frames and steps have one count. A job is never older than that
// of the order before.
#pragma once

#include <variant>

#include "common/image/layers.h"
#include "common/scene/edit.h"
#include "common/scene/settings.h"
#include "proto/messages.h"

namespace ninefold {

struct JobOrder {
  uint32_t job = 1;
  Settings settings;
  uint32_t scene = 0;   // version of the scene
  SceneEdit edit;       // what is different from the version before
  bool moving = false;  // as in msg::Edit
  Delivery delivery;
};

struct FrameOrder : JobOrder {
  FrameKey key;
  bool urgent = false;  // somebody waits for it (FrameKind)
  uint8_t layerMask = kDiffuseBit, extraMask = 0;
  float neighbourWeight = 1;  // of the filter, in [0, 1]; less than 1 only where clients filter

  TileGrid grid() const { return {settings.width, settings.height, settings.interleave}; }
};

struct StepOrder : JobOrder {
  StepKey key;
  bool yields = false;  // frames may be asked for before it is handed out
};

using WorkOrder = std::variant<FrameOrder, StepOrder>;

}  // namespace ninefold
