#include "common/gi/light/minor_lamps.h"

#include <algorithm>

namespace ninefold {

MinorLamps::MinorLamps(const Emitters& emitters, float share, const MinorLamps* begun) {
  if (share <= 0) return;
  if (begun != nullptr) {
    lamps_ = begun->lamps_;
    return;
  }
  struct Lamp {
    double power = 0;
    uint32_t name = 0;
  };
  std::vector<Lamp> lamps;
  double all = 0;
  for (size_t i = 0; i < emitters.size(); ++i) {
    const uint32_t name = lampOf(emitters[i]);
    if (lamps.empty() || lamps.back().name != name) lamps.push_back({0, name});
    const double power = double{maxComponent(emitters[i].flux)};
    lamps.back().power += power, all += power;
  }
  std::stable_sort(lamps.begin(), lamps.end(),
                   [](const Lamp& a, const Lamp& b) { return a.power < b.power; });
  double sum = 0;
  for (const Lamp& lamp : lamps) {
    sum += lamp.power;
    if (share < 1 && sum > double{share} * all) break;
    lamps_.push_back(lamp.name);
  }
  std::sort(lamps_.begin(), lamps_.end());
}

bool MinorLamps::has(uint32_t lamp) const {
  return std::binary_search(lamps_.begin(), lamps_.end(), lamp);
}

}  // namespace ninefold
