// texel_ranges.h: between which values the texels of an image are, channel by channel; what the needs of a
// scene are found from (needs.h).
//
// Looked for once: whoever has finished a scene keeps them with its images, which edits leave as they are.
// Threads: pure functions. Errors: none; of an image without texels 255 to 0.
#pragma once

#include "common/scene/scene.h"

namespace ninefold {

// Those kept with the image, or else by a look at all texels.
TexelRanges texelRanges(const TextureImage& image);

// Keeps them with each image of a valid scene.
void keepTexelRanges(Scene& scene);

}  // namespace ninefold
