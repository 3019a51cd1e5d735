// material_check.h: the ranges that a material's numbers may have; part of validate (reader.h).
// Errors: throws Error, naming `what`.
// Threads: pure.
#pragma once

#include <string>

#include "common/scene/scene.h"

namespace ninefold {

void checkMaterial(const Scene& scene, const Material& material, const std::string& what);

}  // namespace ninefold
