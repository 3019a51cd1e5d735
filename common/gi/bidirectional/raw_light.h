// raw_light.h: irradiance at places that shall become VPLs, from a raw standard set: all its VPLs and
// photons, each with its full power. It is another set than that of the candidates. Those are shared
// out between the families and chosen among: by them alone, every path whose earlier vertex belongs
// to the other family would be lost.
//
//   E(y)   = E_1(y) + E_2(y) + ...      E_c: light whose path has c D vertices, y included
//   E_c(y) = VPLs and photons of c - 1 D vertices before y
//            + compensation: W_e L_e for c = 1, W rho_z/pi E_(c-1)(z) for c > 1
//
// Without a limit of the path length there is one sum. With a limit l there are E_1 ... E_(l-1): a
// point that y lights may be the second D vertex of an eye path, which has room for fewer.
//
// Source:  Segovia et al. 2006, section 3.1; Kollig and Keller 2004.
// Owner:   holds the set.   Threads: const once made; gather is reentrant.   Errors: none.
#pragma once

#include <vector>

#include "common/gi/light_set/light_set.h"

namespace ninefold {

inline constexpr int kReverseLevel = 2;  // y is the second D vertex of an eye path

class RawLight {
 public:
  RawLight(const Transport& transport, LightSet raw);

  const LightSet& set() const { return raw_; }
  // The sums that are kept apart: c = 1 ... sums().
  int sums() const { return byCount_.empty() ? 1 : static_cast<int>(byCount_.size()); }
  // Adds E_c to the receivers; E where there is one sum.
  void gather(int c, const ReceiverSamples& samples, LightSetScratch& scratch, Receivers& receivers,
              RayCounts& rays) const;

 private:
  void gatherAt(int level, int c, const ReceiverSamples& samples, LightSetScratch& scratch,
                Receivers& receivers, RayCounts& rays) const;

  const Transport& t_;
  LightSet raw_;
  std::vector<LightSet> byCount_;  // by c - 1; empty without a limit
};

}  // namespace ninefold
