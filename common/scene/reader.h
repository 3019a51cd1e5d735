// reader.h: scene files to plain data. glTF 2.0 (.gltf, .glb) and Wavefront OBJ (.obj + .mtl).
//
// A scene may stand up to 2^28 times its size from the file's origin: places are read in double
// precision and moved to the origin before they become floats. The vertices of a glTF mesh are
// floats in the file already, so a far mesh must be far by its node's transform.
// Warnings (unknown optional extension, missing camera, ...) go to the log, one line each.
//
// Threads: reentrant.
// Errors:  throws Error with one line (file, place, remedy) on anything bad: truncated, indices out
//          of range, NaN, no geometry, counts over the limits below, a URI that leads outside the
//          scene's folder, an unknown required extension.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "common/scene/environment_file.h"
#include "common/scene/light_units.h"
#include "common/scene/scene.h"

namespace ninefold {

// Limits on what one scene may claim, checked before memory is taken.
inline constexpr uint64_t kMaxTriangles = 50'000'000;  // after instancing
inline constexpr uint64_t kMaxTexels = 1ull << 28;     // of all images together
inline constexpr uint64_t kMaxImageSide = 16384;
inline constexpr uint64_t kMaxFileBytes = 4ull << 30;
inline constexpr uint64_t kMaxInstances = 1'000'000;

// How a file is to be read.
struct ReadOptions {
  std::optional<std::string> clip = {};  // which of its animations plays; nothing: the first
  LightUnits lightUnits = LightUnits::automatic;
  EnvironmentSource environment = {};  // instead of the scene's own
  bool hasColorOutside = false;        // a constant replaces the scene's own environment, also 0

  bool isLitFromOutside() const {
    return hasColorOutside || !std::holds_alternative<std::monostate>(environment);
  }
};

Scene readScene(const std::filesystem::path& file, const ReadOptions& options = {});

// The checks that every scene passes, from a file or from the wire. Throws Error.
void validate(const Scene& scene);

}  // namespace ninefold
