// material_check.h: the ranges that a material's numbers may have; part of validate (reader.h).
// Threads: pure.   Errors: checkMaterial throws Error, naming `what`.
#pragma once

#include <string>

#include "common/scene/scene.h"

namespace ninefold {

// Brings a file's fractions into [0, 1] and negative emission to 0. Changes larger than a rounding
// give a warning that names `what`.
void clampFactors(Material& material, const std::string& what);

// Coat and sheen are layers of opaque materials.
void warnOfLostLayers(const Material& material);

void checkMaterial(const Scene& scene, const Material& material, const std::string& what);

}  // namespace ninefold
