#include "common/gi/state_check/state_check.h"

#include <cstring>

#include "common/base/error.h"
#include "common/sampling/hash.h"

namespace ninefold {
namespace {

constexpr uint32_t kPages = 6;

struct Hashed final : MethodState {
  uint64_t hash = 0;
};

struct Even final : FrameLight {
  float irradiance = 0;
};

constexpr uint64_t kSeedOfOverflow = 0;

SumChange amountOf(uint64_t hash, uint32_t place) {
  return {static_cast<uint16_t>(place), static_cast<int64_t>(hashWords(hash, place)) >> 16};
}

}  // namespace

StepResult StateCheck::step(const StatePages& pages, const StepKey& step, uint32_t unit,
                            const View&) const {
  const uint64_t hash = hashWords(t_.settings.seed, step.randomization, unit, pages.hash());
  Records own(sizeof hash);
  std::memcpy(own.data(), &hash, sizeof hash);
  // Units of a step share places, and take away from some.
  SumChange less = amountOf(hash, 7);
  less.amount = -less.amount;
  if (t_.settings.seed == kSeedOfOverflow) less.amount = int64_t{1} << 60;
  StepResult result;
  result.deltas = {{{0, unit % kPages}, own},
                   {{1, 0}, std::vector{amountOf(hash, 0), amountOf(hash, unit % 4 + 1), less}},
                   {{1, 1}, std::vector{amountOf(hash, static_cast<uint32_t>(kPageSums) - 1)}}};
  result.rays.photon = 1;
  return result;
}

std::shared_ptr<const MethodState> StateCheck::digest(const StatePages& pages,
                                                      const MethodState*) const {
  auto state = std::make_shared<Hashed>();
  state->hash = pages.hash();
  return state;
}

std::shared_ptr<const FrameLight> StateCheck::light(const FrameKey&, int, std::span<const View>,
                                                    const MethodState* state) const {
  NINEFOLD_CHECK(state != nullptr);
  const uint64_t hash = static_cast<const Hashed*>(state)->hash;
  auto light = std::make_shared<Even>();
  light->irradiance =
      kPi * (0.5f + 0x1p-33f * static_cast<float>(static_cast<uint32_t>(hash >> 32)));
  return light;
}

std::unique_ptr<Scratch> StateCheck::makeScratch() const {
  return std::make_unique<LayeredScratch>();
}

void StateCheck::query(const FrameLight& light, const ReceiverSamples&, int, LayeredScratch&,
                       Receivers& receivers, std::vector<Irradiance>*, RayCounts&) const {
  const Irradiance e(static_cast<const Even&>(light).irradiance);
  for (size_t i = 0; i < receivers.size(); ++i) receivers.addIrradiance(i, e);
}

}  // namespace ninefold
