// too_many_lines.h: --max-field-memory has no room for the lines of an intersection field.
//
// A scene as it was read is refused. An edit is not: the picture goes on with what has room
// (client/render_job.h).
#pragma once

#include "common/base/error.h"

namespace ninefold {

struct TooManyLines : Error {
  TooManyLines(const std::string& what, int fittingDirections, int fittingDistances)
      : Error(what), directions(fittingDirections), distances(fittingDistances) {}
  int directions, distances;  // fewer than asked for, which have room; 0: none have
};

}  // namespace ninefold
