// ssim.h: structural similarity of two images, 1 for equal ones.
//
//          1        (2 m_x m_r + c1) (2 s_xr + c2)
//   SSIM = -  sum  -------------------------------------------         c1 = 0.01^2, c2 = 0.03^2
//          n        (m_x^2 + m_r^2 + c1) (s_x^2 + s_r^2 + c2)
//
// over all pixels. m, s^2, s_xr: mean, variance and covariance under a Gaussian window of 11 x 11
// pixels around the pixel, sigma 1.5, cut and renormalized at the border. The measure is made for
// pictures as the eye gets them: x and r are luminances, exposed so that the reference's mean
// becomes 0.18, clamped to [0, 1], in sRGB code.
//
// Source:  Wang et al., "Image Quality Assessment", 2004.   Threads: pure.
#pragma once

#include "common/image/image.h"

namespace ninefold {

// Same sizes, finite pixels, reference mean luminance > 0.
double structuralSimilarity(const RgbImage& image, const RgbImage& reference,
                            double referenceMeanLuminance);

}  // namespace ninefold
