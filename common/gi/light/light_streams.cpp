#include "common/gi/light/light_streams.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "common/base/check.h"
#include "common/sampling/hash.h"

namespace ninefold {
namespace {

// Names an emitter in every state of a scene; ascends in a table of emitters.
auto nameOf(const Emitter& e) { return std::tuple(lampOf(e), e.triangle); }

}  // namespace

LightStreams::LightStreams(const Emitters& now, const Emitters* begun) {
  places_.resize(now.size());
  Stream first;
  if (begun == nullptr || begun->empty()) {
    first.choice = now.byPower();
    first.emitters.resize(now.size());
    std::iota(first.emitters.begin(), first.emitters.end(), 0);
    for (uint32_t i = 0; i < now.size(); ++i) places_[i].place = i;
    streams_.push_back(std::move(first));
    return;
  }
  first.choice = begun->byPower();
  first.emitters.assign(begun->size(), -1);
  Stream second;
  std::vector<float> power;
  double powerOfFirst = 0;
  uint32_t then = 0;
  for (uint32_t i = 0; i < now.size(); ++i) {
    while (then < begun->size() && nameOf((*begun)[then]) < nameOf(now[i])) ++then;
    const bool known = then < begun->size() && nameOf((*begun)[then]) == nameOf(now[i]) &&
                       first.choice.probability(then) > 0;
    const float share = now.byPower().probability(i);
    if (known) {
      first.emitters[then] = static_cast<int>(i);
      places_[i] = {0, then};
      powerOfFirst += static_cast<double>(share);
    } else {
      places_[i] = {1, static_cast<uint32_t>(power.size())};
      second.emitters.push_back(static_cast<int>(i));
      power.push_back(share);
    }
  }
  streams_.push_back(std::move(first));
  second.choice = Distribution(power);
  if (second.choice.empty()) return;
  secondOverFirst_ = powerOfFirst > 0 ? second.choice.total() / powerOfFirst : 1;
  streams_.push_back(std::move(second));
}

LightStreams LightStreams::chosenBy(const std::vector<float>& shares) const {
  NINEFOLD_CHECK(streams_.size() == 1 && shares.size() == places_.size());
  LightStreams other = *this;
  other.streams_.front().choice = Distribution(shares);
  return other;
}

std::optional<Distribution::Choice> LightStreams::choose(size_t stream, float u) const {
  Distribution::Choice choice = streams_[stream].choice.choose(u);
  const int emitter = streams_[stream].emitters[choice.index];
  if (emitter < 0) return std::nullopt;
  choice.index = static_cast<uint32_t>(emitter);
  return choice;
}

float LightStreams::probability(uint32_t emitter) const {
  const Place& place = places_[emitter];
  return place.stream < streams_.size() ? streams_[place.stream].choice.probability(place.place)
                                        : 0.0f;
}

int LightStreams::samples(size_t stream, int n) const {
  if (stream == 0 || n == 0) return n;
  const double wanted = std::ceil(secondOverFirst_ * n);
  return wanted < n ? std::max(1, static_cast<int>(wanted)) : n;
}

uint64_t LightStreams::seedOf(size_t stream, uint64_t seed) {
  return stream == 0 ? seed : hashWords(seed, stream);
}

}  // namespace ninefold
