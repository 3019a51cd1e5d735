// too_large.h: a method has no room for a scene under its settings. It says under which it has.
//
// A scene as it was read is refused. An edit is not: the picture goes on under the settings that
// fit (client/render_job.h).
#pragma once

#include <optional>

#include "common/base/error.h"
#include "common/scene/settings.h"

namespace ninefold {

struct TooLarge : Error {
  struct Smaller {
    Settings settings;
    std::string size;  // of what they make, for people
  };
  TooLarge(const std::string& what, std::optional<Smaller> smaller)
      : Error(what), fitting(std::move(smaller)) {}
  std::optional<Smaller> fitting;  // nothing: none that it knows
};

}  // namespace ninefold
