#include "common/image/discontinuity_buffer.h"

#include "common/base/vectors.h"

namespace ninefold {

// Sums over the window, for kLanes pixels.
struct DiscontinuityBuffer::Sums {
  Floats weight, r, g, b;
};

template <typename Take>
void DiscontinuityBuffer::sum(const Patch& patch, int layer, int phase, float weight,
                              const Take& take) const {
  const TaskRect& inner = patch.inner(phase);
  if (inner.count() == 0) return;
  const auto lightOf = [&](int p) -> const RgbPlane& {
    return patch.phase(p).layers[static_cast<size_t>(layer)].irradiance;
  };
  struct Neighbour {
    const float *r, *g, *b;
    const uint32_t* links;
    uint32_t bit;
  };
  std::vector<Neighbour> neighbours;
  for (const SurfaceLinks::Neighbour& at : links_.neighbours(phase)) {
    const RgbPlane& light = lightOf(at.phase);
    neighbours.push_back({light.r.data() + at.shift, light.g.data() + at.shift,
                          light.b.data() + at.shift, links_.links(layer, at.linkPhase) + at.linkAt,
                          at.linkBit});
  }
  const RgbPlane& light = lightOf(phase);
  const int end = inner.height * Patch::kSide + inner.width + 1;
  for (int first = Patch::kSide + 1; first < end; first += kLanes) {
    // The last ones once more rather than a neighbour behind the planes' end.
    const int i = std::min(first, Patch::kPixels - (Patch::kSide + 1) - kLanes);
    const Floats r = floatsAt(&light.r[size_t(i)]), g = floatsAt(&light.g[size_t(i)]),
                 b = floatsAt(&light.b[size_t(i)]);
    const Floats w = Floats{} + weight;
    Sums sums{Floats{} + 1.0f, {}, {}, {}};
    for (const Neighbour& at : neighbours) {
      const Mask goesOn = (wordsAt(at.links + i) & at.bit) != 0;
      sums.weight += masked(w, goesOn);
      sums.r += masked(w * (floatsAt(at.r + i) - r), goesOn);
      sums.g += masked(w * (floatsAt(at.g + i) - g), goesOn);
      sums.b += masked(w * (floatsAt(at.b + i) - b), goesOn);
    }
    take(static_cast<size_t>(i), sums);
  }
}

void DiscontinuityBuffer::filter(const Patch& patch, int layer, int phase, float neighbourWeight,
                                 RgbPlane& out) const {
  const RgbPlane& light = patch.phase(phase).layers[static_cast<size_t>(layer)].irradiance;
  sum(patch, layer, phase, neighbourWeight, [&](size_t i, const Sums& sums) {
    put(floatsAt(&light.r[i]) + sums.r / sums.weight, &out.r[i]);
    put(floatsAt(&light.g[i]) + sums.g / sums.weight, &out.g[i]);
    put(floatsAt(&light.b[i]) + sums.b / sums.weight, &out.b[i]);
  });
}

void DiscontinuityBuffer::shares(const Patch& patch, int layer, int phase, float neighbourWeight,
                                 std::vector<float>& out) const {
  const auto sets = static_cast<float>(patch.phases());
  out.assign(Patch::kPixels, 0);
  sum(patch, layer, phase, neighbourWeight,
      [&](size_t i, const Sums& sums) { put(sums.weight / sets, &out[i]); });
}

}  // namespace ninefold
