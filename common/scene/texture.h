// texture.h: texture lookup. Returns linear values (sRGB images are decoded before interpolation).
// Missing channels read as: grey spreads to R, G, B; alpha 1. Threads: pure. Errors: none for valid scenes.
#pragma once

#include "common/scene/scene.h"

namespace ninefold {

Vec4 lookUp(const Scene& scene, const TextureUse& use, Vec2 uv0, Vec2 uv1);

}  // namespace ninefold
