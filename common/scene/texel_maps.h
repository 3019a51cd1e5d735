// texel_maps.h: images made from images, texel by texel, for what a map of a material says beyond
// "these are its texels". Where two images differ in size, the larger counts; the other is looked
// up at its nearest texel.
//
// Units:   values are 0..1. Colours are decoded (sRGB) before they are changed and encoded after.
// Threads: pure.   Errors: none; images have at least one texel.
#pragma once

#include "common/scene/scene.h"

namespace ninefold {

// value' = clamp(base + gain value, 0, 1).
struct Gain {
  float base = 0, gain = 1;
  bool isIdentity() const { return base == 0 && gain == 1; }
};

// One channel: r, g, b, m (alpha), l (luminance, Rec. 709 weights); 0: luminance.
TextureImage scalarOf(const TextureImage& image, char channel, Gain gain);

// How much of a surface is there: the alpha channel if it says anything, else the luminance.
char coverageChannel(const TextureImage& image);

// R, G, B without alpha. `channel`: not 0 makes it grey.
TextureImage coloursOf(const TextureImage& image, char channel, Gain gain);

// R, G, B of `colours`, alpha of `coverage`, which has one channel.
TextureImage coveredBy(const TextureImage& colours, const TextureImage& coverage);

// The image as looked up by `use` over the square of texture coordinates 0..1, at the nearest
// texels. It repeats as `image` does if the scales are whole numbers.
TextureImage asSeenBy(const TextureUse& use, const TextureImage& image);

// G = roughness, B = metallic, of one channel each; null counts as 1.
TextureImage metallicRoughness(const TextureImage* roughness, const TextureImage* metallic);

// glTF's normal map (G points up) of heights in one channel, after Blinn 1978. From black to white
// within the width of a texel is a slope of `strength`: MTL has no unit of height.
TextureImage normalsOfHeights(const TextureImage& heights, float strength, Wrap wrap);

// True if blue is the largest channel nearly everywhere: normals about a surface's own, no heights.
bool isNormalMap(const TextureImage& image);

// The normal map with its slopes times `strength`.
TextureImage scaledNormals(const TextureImage& normals, float strength);

}  // namespace ninefold
