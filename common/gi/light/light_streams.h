// light_streams.h: which lamp each sample of a light set starts from.
//
//   at rest        One stream of n samples. Lamps are chosen in proportion to power (emitters.h).
//   for a view     Methods may choose by other shares than power (chosenBy).
//   in a gesture   The first stream chooses with the probabilities that the gesture began with. So
//                  a sample stays with its lamp, whatever is done to the others; it finds no light
//                  if that lamp is off now. Lamps that were off then have a second stream:
//                  n' = n Phi'/Phi samples, 1 to n
//                  Phi, Phi': power of the first and of the second stream's lamps [W]
//
// Each emitter is in one stream, and is divided by its probability there. So frozen probabilities
// cost noise, never energy.
//
// Threads: const after construction.   Errors: none.   Proved: tests/gi/gesture_test.cpp.
#pragma once

#include <optional>
#include <vector>

#include "common/scene/emitters.h"

namespace ninefold {

class LightStreams {
 public:
  // `begun`: the lamps that a gesture began with; null at rest.
  LightStreams(const Emitters& now, const Emitters* begun);

  // The same lamps, chosen by other shares, one an emitter: where there is one stream.
  LightStreams chosenBy(const std::vector<float>& shares) const;

  size_t count() const { return streams_.size(); }
  // The emitter that sample u of a stream takes; nothing if it is off now.
  std::optional<Distribution::Choice> choose(size_t stream, float u) const;
  // Probability of an emitter in its stream.
  float probability(uint32_t emitter) const;
  // Number of samples of a stream; n: of the first.
  int samples(size_t stream, int n) const;
  // Streams share no random numbers.
  static uint64_t seedOf(size_t stream, uint64_t seed);

 private:
  struct Stream {
    Distribution choice;
    std::vector<int> emitters;  // by place in `choice`; -1: off now
  };
  struct Place {
    uint32_t stream = 0, place = 0;
  };
  std::vector<Stream> streams_;
  std::vector<Place> places_;  // by emitter
  double secondOverFirst_ = 0;
};

}  // namespace ninefold
