// texel_ranges.h: smallest and largest value of an image's texels, channel by channel. The needs of
// a scene are found from them (needs.h). Whoever has finished a scene keeps them with its images,
// which edits leave as they are.
//
// Threads: pure functions.   Errors: none; of an image without texels 255 to 0.
#pragma once

#include "common/scene/scene.h"

namespace ninefold {

// The ranges kept with the image; if there are none, found by a look at all texels.
TexelRanges texelRanges(const TextureImage& image);

// Keeps the ranges with each image of a valid scene.
void keepTexelRanges(Scene& scene);

}  // namespace ninefold
