// What a row lost and got leads from its hits to those of the other version, whatever they are. It
// is little where little has changed.
#include "common/gi/elements/hit_changes.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <tuple>

#include "tests/seeds.h"

namespace ninefold {
namespace {

using Counts = std::map<std::tuple<uint32_t, uint16_t, uint16_t, uint32_t>, int>;

ElementHit randomHit(std::mt19937_64& random, uint32_t kinds) {
  const auto kind = static_cast<uint32_t>(random() % kinds);
  return {kind, static_cast<uint16_t>(kind % 7), static_cast<uint16_t>(kind % 5), kind};
}

void count(Counts& counts, const ElementHit& h, int amount) {
  int& of = counts[{h.surface, h.u, h.v, h.flux}];
  of += amount;
  if (of == 0) counts.erase({h.surface, h.u, h.v, h.flux});
}

size_t expectChangesLead(const std::vector<ElementHit>& before,
                         const std::vector<ElementHit>& now) {
  Counts left;
  size_t changes = 0;
  for (const ElementHit& h : before) count(left, h, 1);
  forEachChange(
      before, now, [&](const ElementHit& h) { count(left, h, -1), ++changes; },
      [&](const ElementHit& h) { count(left, h, 1), ++changes; });
  for (const ElementHit& h : now) count(left, h, -1);
  EXPECT_TRUE(left.empty());
  return changes;
}

TEST(HitChanges, LeadFromOneVersionToTheOther) {
  for (const uint64_t seed : seedsFrom(1, 200)) {
    const Repeatable repeatable(seed);
    std::mt19937_64 random(seed);
    const uint32_t kinds = random() % 2 == 0 ? 4 : 100000;
    std::vector<ElementHit> before(random() % 300), now(random() % 300);
    for (ElementHit& h : before) h = randomHit(random, kinds);
    for (ElementHit& h : now) h = randomHit(random, kinds);
    expectChangesLead(before, now);
  }
}

TEST(HitChanges, AreAsFewAsThePhotonsThatWentOtherWays) {
  for (const uint64_t seed : seedsFrom(1, 50)) {
    const Repeatable repeatable(seed);
    std::mt19937_64 random(seed);
    std::vector<ElementHit> before, now;
    size_t changed = 0;
    for (int photon = 0; photon < 256; ++photon) {
      std::vector<ElementHit> hits(random() % 5);
      for (ElementHit& h : hits) h = randomHit(random, 1u << 30);
      before.insert(before.end(), hits.begin(), hits.end());
      if (random() % 20 == 0) {
        changed += hits.size();
        hits.assign(random() % 5, {});
        for (ElementHit& h : hits) h = randomHit(random, 1u << 30);
        changed += hits.size();
      }
      now.insert(now.end(), hits.begin(), hits.end());
    }
    EXPECT_EQ(expectChangesLead(before, now), changed);
  }
}

}  // namespace
}  // namespace ninefold
