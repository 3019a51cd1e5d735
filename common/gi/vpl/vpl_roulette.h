// vpl_roulette.h: fewer shadow rays for the same picture. A packet of receivers asks only some of the
// VPLs that would add little, and weights those by the inverse of their probability:
//
//   c_v   largest contribution of VPL v to a receiver of the packet if nothing is in between; of glossy
//         lobes what goes to the first receiver counts
//   tau   sum c_v / max(n/f, 5),   n = number of VPLs with c_v > 0; all are asked if n <= 5
//   p_v   c_v / tau, from 1/16 to 1 (what adds little may be all that is not hidden);   weight times 1/p_v with probability p_v, else 0
//
// Which ones is decided by systematic sampling: one uniform number u, and VPL v is taken when the
// running sum u + p_1 + ... + p_v passes an integer. So the number taken hardly varies, and the
// estimate stays unbiased, for each VPL alone is taken with probability p_v.
//
// f = 0: all are asked. Measured with 22 VPLs a set, 160x120, 16 frames, six seeds (table_room, office,
// conference): at f = 4 0.28 to 0.30 of the rays, the squared error 1 to 4 % larger; f = 2 with 8 for 5:
// 0.38 to 0.41 and 0 to 2 %; f = 5 with 3: 0.22 and 2 to 8 %.
//
// Source:  Russian roulette, Arvo and Kirk 1990; systematic sampling, Cochran 1977, ch. 8; choice by
// unoccluded contribution as in Wald et al. 2003 and the survey of Dachsbacher et al. 2014.
// Proved:  tests/gi (furnace, polygon light, mean with and without).
// Threads: one owner at a time.   Errors: none.
#pragma once

#include "common/gi/eye/receiver_samples.h"
#include "common/gi/vpl/vpl_weights.h"

namespace ninefold {

class VplRoulette {
 public:
  // Changes the weights of all packets of a chunk that begins at receiver `begin`; u for a packet is
  // its first receiver's sample.
  void play(float f, const VplSet& lights, const ReceiverSamples& samples, int pathVertices,
            const Receivers& receivers, size_t begin, VplWeights& weights);

 private:
  void playPacket(float f, const VplSet& lights, float u, Vec3 x, size_t first,
                  VplWeights& weights);

  std::vector<float> contributions_;  // c_v of one packet
};

}  // namespace ninefold
