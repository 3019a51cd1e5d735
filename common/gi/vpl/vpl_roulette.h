// vpl_roulette.h: fewer shadow rays for the same picture. A packet of receivers asks only some of
// the VPLs that would add little, and weights the asked ones by 1/p_v.
//
//   c_v   largest contribution of VPL v to a receiver of the packet if nothing is in between; a
//         glossy lobe counts by what it sends to the first receiver. Where the set knows that a VPL
//         is hidden from most (Vpl::seen), it counts by so much less. With seen = 0 it counts
//         nothing and is always asked: whoever sees it after all would get 16 times as much.
//   n     number of VPLs with c_v > 0; all are asked if n <= 5
//   tau   sum c_v / max(n/f, 5)
//   p_v   probability of VPL v: c_v / tau, clamped to [1/16, 1]; not less, as a faint VPL may be
//         all that is not hidden
//
// Systematic sampling decides, with one uniform number u: VPL v is taken when the running sum
// u + p_1 + ... + p_v passes an integer. So the number taken hardly varies. The estimate is
// unbiased, for each VPL alone is taken with probability p_v.
//
// f = 0: all are asked. Measured with 22 VPLs a set, 160x120, 16 frames, six seeds (table_room,
// office, conference):
//
//   f   at least    rays            squared error
//   4   5           0.28 to 0.30    1 to 4 % larger
//   2   8           0.38 to 0.41    0 to 2 % larger
//   5   3           0.22            2 to 8 % larger
//
// Source:  Russian roulette, Arvo and Kirk 1990; systematic sampling, Cochran 1977, ch. 8; choice
//          by unoccluded contribution as in Wald et al. 2003 and Dachsbacher et al. 2014 (survey).
// Proved:  tests/gi (furnace, polygon light, mean with and without).
// Threads: one owner at a time.   Errors: none.
#pragma once

#include "common/gi/eye/receiver_samples.h"
#include "common/gi/vpl/vpl_weights.h"

namespace ninefold {

class VplRoulette {
 public:
  // Changes the weights of all packets of a chunk that begins at receiver `begin`. A packet's u is
  // its first receiver's sample.
  void play(float f, const VplSet& lights, const ReceiverSamples& samples, int pathVertices,
            const Receivers& receivers, size_t begin, VplWeights& weights);

 private:
  void playPacket(float f, const VplSet& lights, float u, Vec3 x, size_t first,
                  VplWeights& weights);

  std::vector<float> contributions_;  // c_v of one packet
};

}  // namespace ninefold
