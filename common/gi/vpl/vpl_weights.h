// vpl_weights.h: the factors on a VPL's power at a receiver if nothing is in between; symbols as in
// vpl_gather.h:
//
//   surface            min(G, b) cos_s/cos_x   [1/m^2]
//   point, spot        falloff(w) cos_s / d^2  [1/m^2]
//   goniometric        f(w) cos_s / d^2        [1/m^2]   f: light_profile.h
//   directional        cos_s                   [1]
//
// 0 where a cosine is not positive, where d = 0, and where the path would be too long.
//
// Source:  Keller 1997; Wald et al. 2002.   Threads: one owner at a time.   Errors: none.
#pragma once

#include <span>

#include "common/gi/eye/receivers.h"
#include "common/gi/light/transport.h"
#include "common/gi/vpl/vpl.h"

namespace ninefold {

// The weights of all VPLs at a chunk of receivers, VPL-major. Memory is kept between chunks.
class VplWeights {
 public:
  // Receivers of a chunk, a multiple of kPacket, so that a chunk stays in the second-level cache.
  static size_t chunk(size_t vpls) {
    constexpr size_t kEntries = 1 << 16;
    return std::max<size_t>(kEntries / std::max<size_t>(vpls, 1) / kPacket, 1) * kPacket;
  }

  // For receivers begin ... begin + size - 1; `size` a multiple of kPacket.
  void fill(const Transport& transport, std::span<const Vpl> vpls, int pathVertices,
            const Receivers& receivers, size_t begin, size_t size);

  size_t size() const { return size_; }
  // Weights of VPL v for the packet that starts `first` receivers into the chunk.
  float* at(size_t v, size_t first) { return weights_.data() + v * size_ + first; }

 private:
  std::vector<float> weights_;
  size_t size_ = 0;
};

}  // namespace ninefold
