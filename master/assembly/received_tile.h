// received_tile.h: a result on its way from a client's session to a frame. Plain value.
#pragma once

#include "master/scheduling/scheduler_types.h"
#include "proto/messages.h"
#include "proto/tile_codec.h"

namespace ninefold {

struct ReceivedTile {
  ClientId client = 0;
  msg::Result result;
  Time arrived{};
  // A digest of it is wanted, also if its frame has the tile already.
  std::optional<TileShape> toCompare = std::nullopt;
  std::optional<Digest> digest = std::nullopt;
};

}  // namespace ninefold
