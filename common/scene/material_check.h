// material_check.h: the ranges that a material's numbers may have; part of validate (reader.h).
// Errors: checkMaterial throws Error, naming `what`.
// Threads: pure.
#pragma once

#include <string>

#include "common/scene/scene.h"

namespace ninefold {

// Fractions of a file that lie outside of 0 to 1 become the nearer end, negative emission 0; by
// more than a rounding with a warning that names `what`.
void clampFactors(Material& material, const std::string& what);

void checkMaterial(const Scene& scene, const Material& material, const std::string& what);

}  // namespace ninefold
