// denoise.h: a last touch for a picture that people look at. Where the error says that a pixel may
// be wrong, it takes what its neighbours say; where the error is 0, it stays as it is, bit for bit.
//
//   c'(p) = c(p) + t(p) d(p)        d(p) = b0 - c(p)
//
//   b0, b   least squares: minimize over b0, b (for each colour)
//             sum_q w(p,q) |b0 + b . f(p,q) - c(q)|^2 + sum_k r_k b_k^2 sum_q w(p,q)
//           over the window of (2 kReach + 1)^2 pixels around p; r: ridge, small
//   f       what colour may depend on in the window: (albedo(q) - albedo(p), (q - p)/kReach)
//   w       K(D/9 + G) h(q)               K(x) = max(0, 1 - x/8)^8, much as exp(-x)
//   D       sum over the 3x3 pixels i around p, and j around q, at least 0:
//             (|c_i - c_j|^2 - V_i - min(V_i, V_j)) / (V_i + V_j)
//   G       |n_p - n_q|^2/(2 kNormal^2) + z^2/(2 kNearness^2) + (a_p - a_q)^2/(2 kAlbedo^2)
//           a: albedo; z: how far q's nearness lies off p's tangent plane, over p's nearness
//   h       1/(1 + kDoubt e_q^2/g_q)      g: geometric mean of e^2 over 7x7 pixels
//   V       e^2 |c|^2/Y^2, mean over 3x3 pixels     e: the film's standard error of luminance Y
//   t       min(1, e(p)/|Y(d)|); 0 where e is 0
//
// So no luminance moves by more than its own standard error, and the touch dies out with the error:
// what the film tends to, the shown picture tends to. A firefly has an error as large as itself: it
// may be moved all the way, and counts for little where others are moved (h). Albedo comes in by
// the regression, not by a division: a texture under even light is b0 + b albedo, too, while the
// noise of an edge's coverage, which colour and albedo share, is averaged and does not come back.
//
// With all differences 0 the sums are 0: a constant picture stays constant, bit for bit. Sums run
// in one order, row by row of the window, whatever the threads.
//
// Fails:   noise that is smooth over the window (pixels share light sets) looks like light and
//          stays. Error that no frame has seen yet is not known. A texture in which no two patches
//          are alike keeps its noise.
// Source:  Bitterli et al. 2016 (nonlinearly weighted first-order regression); Rousselle, Manzi
//          and Zwicker 2013 (distances of patches less their variance, guides).
// Proved:  tests/image/denoise_test.cpp; measured in docs/performance.md.
// Threads: starts and ends its own.   Memory: some 80 bytes a pixel meanwhile.
// Errors:  none; the planes must be of the picture's size. Pixels that are not finite stay, and
//          nobody takes from them.
#pragma once

#include <stop_token>
#include <vector>

#include "common/image/image.h"

namespace ninefold {

// Of what a pixel shows; means over the picture's frames, of the same samples as its colours.
struct DenoiseGuides {
  std::vector<float> albedo;    // grey, in [0, 1]
  RgbPlane normal;              // of any length up to 1; 0 where nothing is
  std::vector<float> nearness;  // 1/distance [1/m]; 0 where nothing is
};

// False if it was stopped: then some of the picture is touched.
bool denoise(RgbImage& picture, const std::vector<float>& standardError,
             const DenoiseGuides& guides, int threads, const std::stop_token& stop = {});

}  // namespace ninefold
