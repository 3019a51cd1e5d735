#include "common/gi/bidirectional/resampling.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "common/gi/bidirectional/tournament.h"

namespace ninefold {
namespace {

// tau for which sum min(1, c/tau) = count, 0 < count < c.size(): the largest are certain, the rest
// share what is left.
double threshold(std::vector<double> c, size_t count) {
  std::sort(c.begin(), c.end(), std::greater<>());
  double rest = 0;
  for (const double v : c) rest += v;
  size_t certain = 0;
  while (certain < count && c[certain] * static_cast<double>(count - certain) >= rest)
    rest -= c[certain++];
  return certain == count ? c[count - 1] : rest / static_cast<double>(count - certain);
}

double finite(float worth) { return std::isfinite(worth) ? static_cast<double>(worth) : 0; }

}  // namespace

std::vector<Kept> resample(std::span<const float> worth, std::span<const Vec3> positions, int count,
                           Metres radius, uint64_t key) {
  if (count <= 0) return {};
  double sum = 0;
  for (const float v : worth) sum += finite(v);
  const double floor = sum > 0 ? sum / static_cast<double>(worth.size()) : 1.0;
  std::vector<double> c;
  for (const float v : worth) c.push_back(finite(v) + floor);
  const bool all = worth.size() <= static_cast<size_t>(count);
  const double tau = all ? 0 : threshold(c, static_cast<size_t>(count));
  std::vector<Contender> contenders;
  for (size_t j = 0; j < c.size(); ++j)
    contenders.push_back({positions[j], all || c[j] >= tau ? 1 : c[j] / tau});
  std::vector<Kept> kept;
  for (const uint32_t j : tournament(contenders, radius, key))
    kept.push_back({j, static_cast<float>(1 / contenders[j].p)});
  return kept;
}

}  // namespace ninefold
