// received_tile.h: a result on its way from a client's session to a frame. Plain value.
#pragma once

#include "master/scheduling/scheduler_types.h"
#include "proto/messages.h"

namespace ninefold {

struct ReceivedTile {
  ClientId client = 0;
  msg::Result result;
  Time arrived{};
};

}  // namespace ninefold
