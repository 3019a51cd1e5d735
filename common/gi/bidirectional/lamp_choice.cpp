#include "common/gi/bidirectional/lamp_choice.h"

#include "common/gi/bidirectional/worth.h"
#include "common/gi/vpl/direct_vpls.h"
#include "common/gi/vpl/indirect_vpls.h"

namespace ninefold {
namespace {

constexpr double kByPower = 0.2, kWorthwhile = 2;
constexpr uint32_t kPilotRandomization = 0xfffffff0u;  // of no frame
constexpr int kRoundLog2 = 7;                          // light paths of a round, and direct VPLs
constexpr size_t kLeastRounds = 8, kSamplesPerLamp = 16, kMostLamps = 512;

// The lamps of a table of emitters, where they lie side by side.
struct Lamps {
  std::vector<uint32_t> names;     // ascending
  std::vector<size_t> ofEmitters;  // indices into names

  explicit Lamps(const Emitters& emitters) {
    for (size_t i = 0; i < emitters.size(); ++i) {
      const uint32_t name = lampOf(emitters[i]);
      if (names.empty() || names.back() != name) names.push_back(name);
      ofEmitters.push_back(names.size() - 1);
    }
  }
  size_t find(uint32_t name) const {
    return static_cast<size_t>(std::lower_bound(names.begin(), names.end(), name) - names.begin());
  }
};

// Adds what one round of the pilot finds to W_l.
void addRound(const Transport& t, const View& view, int round, bool paths, const Lamps& lamps,
              std::vector<double>& worths) {
  FrameKey key;
  key.randomization = kPilotRandomization;
  RayCounts rays;
  VplSet pilot;
  const int direct = std::max(t.settings.directVpls, 1);
  addDirectVpls(t, key, round, std::max((1 << kRoundLog2) / direct, 1), pilot.vpls);
  if (paths) addIndirectVpls(t, key, round, kRoundLog2, pilot, rays);
  const CameraPoints camera =
      cameraPoints(t, {&view, 1}, key, round, static_cast<int>(CameraPoints::kJudges), rays);
  Worth worth(t, camera);
  VplGatherScratch scratch;
  for (const Vpl& vpl : pilot.vpls) worth.add(pilot, vpl, scratch, rays);
  const std::vector<float> values = worth.values();
  for (size_t j = 0; j < values.size(); ++j)
    if (std::isfinite(values[j])) worths[lamps.find(pilot.vpls[j].lamp)] += double{values[j]};
}

// p of each emitter; empty if power is as good.
std::vector<float> sharesOf(const Transport& t, const Lamps& lamps,
                            const std::vector<double>& worths) {
  double sum = 0;
  for (const double w : worths) sum += w;
  if (!(sum > 0)) return {};
  std::vector<double> power(worths.size(), 0);
  const auto byPower = [&](size_t i) {
    return double{t.streams.probability(static_cast<uint32_t>(i))};
  };
  for (size_t i = 0; i < lamps.ofEmitters.size(); ++i) power[lamps.ofEmitters[i]] += byPower(i);
  double uneven = 0;
  for (size_t lamp = 0; lamp < power.size(); ++lamp)
    if (power[lamp] > 0) uneven += worths[lamp] / sum * (worths[lamp] / sum) / power[lamp];
  if (uneven < kWorthwhile) return {};
  std::vector<float> shares;
  for (size_t i = 0; i < lamps.ofEmitters.size(); ++i) {
    const size_t lamp = lamps.ofEmitters[i];
    const double gain =
        power[lamp] > 0 ? kByPower + (1 - kByPower) * worths[lamp] / (sum * power[lamp]) : 0;
    shares.push_back(static_cast<float>(gain * byPower(i)));
  }
  return shares;
}

}  // namespace

LampChoice lampChoiceFor(const Transport& t, const View& view, bool paths) {
  const Lamps lamps(t.emitters);
  if (lamps.names.size() < 2 || lamps.names.size() > kMostLamps || t.streams.count() > 1) return {};
  std::vector<double> worths(lamps.names.size(), 0);
  const size_t rounds =
      std::max(kLeastRounds, (kSamplesPerLamp * lamps.names.size()) >> kRoundLog2);
  for (size_t round = 0; round < rounds; ++round)
    addRound(t, view, static_cast<int>(round), paths, lamps, worths);
  const std::vector<float> shares = sharesOf(t, lamps, worths);
  if (shares.empty()) return {};
  auto chosen = std::make_shared<Transport>(t);
  chosen->streams = t.streams.chosenBy(shares);
  // Few paths will do for s: they are where they are asked for.
  return {chosen, std::make_shared<const StandardDensity>(*chosen, kRoundLog2)};
}

}  // namespace ninefold
