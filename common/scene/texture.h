// texture.h: texture lookup. Returns linear values (sRGB images are decoded before interpolation).
// Missing channels read as: grey spreads to R, G, B; alpha 1.
// Threads: pure.   Errors: none for valid scenes.
#pragma once

#include "common/scene/scene.h"

namespace ninefold {

// Value at a mesh's texture coordinates; `use` must name an image.
Vec4 lookUp(const Scene& scene, const TextureUse& use, Vec2 uv0, Vec2 uv1);

// Texture coordinates after KHR_texture_transform: scale, then rotate counter-clockwise as seen in
// the image (v points down), then shift.
Vec2 textureCoordinates(const TextureUse& use, Vec2 uv);

// One texel, linear. Index of texel i of a row or column of `size` after wrapping.
Vec4 texelOf(const TextureImage& image, int x, int y);
int wrapTexel(int i, int size, Wrap wrap);

}  // namespace ninefold
