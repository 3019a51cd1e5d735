// environment_file.h: where light from outside comes from, if it is no constant: a picture's file
// or a sky by its formula.
//
// A picture is .hdr (Radiance) or .exr, equirectangular (environment_map.h), linear Rec. 709. Wider
// ones than kWidestEnvironment are halved, by means of four texels. A negative value is taken as 0,
// with a warning.
//
// Threads: reentrant.
// Errors:  throws Error that names the file: unreadable, truncated, not twice as wide as high, too
//          large, a value that is no finite number.
#pragma once

#include <memory>
#include <string>
#include <variant>

#include "common/scene/environment_map.h"
#include "common/scene/sky_model.h"

namespace ninefold {

inline constexpr uint64_t kWidestEnvironmentFile = 8192;

struct EnvironmentFile {
  std::string path;
  double rotation = 0;  // [degrees]
  double strength = 1;
};

// Nothing: the scene's own environment.
using EnvironmentSource = std::variant<std::monostate, EnvironmentFile, SkyModel>;

// A value of --environment that names a picture: FILE[:ROTATION[:STRENGTH]]. Throws UsageError.
bool namesPicture(const std::string& value);
EnvironmentFile parseEnvironmentFile(const std::string& value);

// Null where the source is nothing.
std::shared_ptr<const EnvironmentMap> readEnvironment(const EnvironmentSource& source);

// What the picture's values are multiplied by.
float strengthOf(const EnvironmentSource& source);

}  // namespace ninefold
