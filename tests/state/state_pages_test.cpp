// Versions of a state: sums do not ask for an order, and what was added can be taken away.
#include "common/state/state_pages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <random>
#include <string>

#include "common/base/error.h"
#include "tests/seeds.h"

namespace ninefold {
namespace {

using Changes = std::vector<SumChange>;
constexpr int64_t kMost = std::numeric_limits<int64_t>::max();

std::string errorOf(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

Records bytes(std::initializer_list<int> values) {
  Records records;
  for (const int value : values) records.push_back(static_cast<std::byte>(value));
  return records;
}

// Equal pages, to the last bit. A page of zeros is not the same as none.
void expectSame(const StatePages& a, const StatePages& b) {
  EXPECT_EQ(a.hash(), b.hash());
  ASSERT_EQ(a.all().size(), b.all().size());
  for (const auto& [id, page] : a.all()) {
    ASSERT_NE(b.find(id), nullptr);
    EXPECT_EQ(*b.find(id), *page) << id.kind << "." << id.index;
  }
}

PageDeltas randomSums(std::mt19937_64& random) {
  PageDeltas deltas;
  for (uint32_t index = 0; index < 3; ++index) {
    Changes changes(random() % 6);
    for (auto& [place, amount] : changes) {
      place = static_cast<uint16_t>(random() % 4 == 0 ? kPageSums - 1 : random() % 5);
      amount = static_cast<int64_t>(random()) >> (4 + random() % 60);
    }
    deltas.push_back({{7, index}, std::move(changes)});
  }
  return deltas;
}

PageDeltas negated(PageDeltas deltas) {
  for (PageDelta& delta : deltas)
    for (SumChange& change : std::get<Changes>(delta.change)) change.amount = -change.amount;
  return deltas;
}

TEST(StatePages, SumsAreTheSameInAnyOrder) {
  for (const uint64_t seed : seedsFrom(1, 40)) {
    const Repeatable repeatable(seed);
    std::mt19937_64 random(seed);
    std::vector<PageDeltas> all;
    for (int i = 0; i < 8; ++i) all.push_back(randomSums(random));
    StatePages forth, shuffled, atOnce;
    for (const PageDeltas& deltas : all) forth.apply(deltas);
    std::shuffle(all.begin(), all.end(), random);
    PageDeltas together;
    for (const PageDeltas& deltas : all) {
      shuffled.apply(deltas);
      together.insert(together.end(), deltas.begin(), deltas.end());
    }
    std::shuffle(together.begin(), together.end(), random);
    atOnce.apply(together);
    expectSame(forth, shuffled);
    expectSame(forth, atOnce);
    StatePages group;
    group.applyAll(all);
    expectSame(forth, group);
  }
}

TEST(StatePages, WhatWasAddedCanBeTakenAway) {
  for (const uint64_t seed : seedsFrom(1, 40)) {
    const Repeatable repeatable(seed);
    std::mt19937_64 random(seed);
    StatePages pages;
    for (int i = 0; i < 4; ++i) pages.apply(randomSums(random));
    const StatePages before = pages;
    const PageDeltas first = randomSums(random), second = randomSums(random);
    pages.apply(first), pages.apply(second);
    pages.apply(negated(first)), pages.apply(negated(second));
    expectSame(pages, before);
  }
}

TEST(StatePages, APageOfNothingIsAsGoodAsNone) {
  StatePages pages;
  EXPECT_EQ(pages.hash(), 0u);
  pages.apply({{{1, 2}, Changes{{3, 4}}}, {{2, 0}, bytes({1})}});
  EXPECT_NE(pages.hash(), 0u);
  pages.apply({{{1, 2}, Changes{{3, -4}}}, {{2, 0}, Records()}});
  EXPECT_EQ(pages.hash(), 0u);
  pages.apply({{{1, 3}, Changes()}});
  EXPECT_EQ(pages.hash(), 0u);
}

TEST(StatePages, RecordsAreReplaced) {
  StatePages pages, direct;
  pages.apply({{{1, 2}, bytes({1, 2, 3, 4, 5, 6, 7, 8, 9})}});
  pages.apply({{{1, 2}, bytes({7})}});
  direct.apply({{{1, 2}, bytes({7})}});
  expectSame(pages, direct);
}

TEST(StatePages, EveryBitAndEveryPlaceIsInTheHash) {
  const auto hashOf = [](PageId id, const auto& change) {
    StatePages pages;
    pages.apply({{id, change}});
    return pages.hash();
  };
  std::vector<uint64_t> hashes;
  for (const PageId id : {PageId{1, 2}, PageId{1, 3}, PageId{2, 2}}) {
    for (size_t size : {1u, 7u, 8u, 9u, 16u}) {
      hashes.push_back(hashOf(id, Records(size)));
      for (size_t i = 0; i < size; ++i) {
        Records records(size);
        records[i] = std::byte{1};
        hashes.push_back(hashOf(id, records));
      }
    }
    for (const uint16_t place : {uint16_t{0}, uint16_t{1}, uint16_t{8191}})
      for (int bit = 0; bit < 63; ++bit)
        hashes.push_back(hashOf(id, Changes{{place, int64_t{1} << bit}}));
  }
  std::ranges::sort(hashes);
  EXPECT_EQ(std::ranges::adjacent_find(hashes), hashes.end());
}

TEST(StatePages, CopiesShareWhatNeitherChanges) {
  StatePages pages;
  pages.apply({{{1, 0}, Changes{{0, 1}}}, {{1, 1}, Changes{{0, 1}}}, {{2, 0}, bytes({1})}});
  const StatePages before = pages;
  const uint64_t hash = before.hash();
  EXPECT_EQ(pages.find({1, 0}), before.find({1, 0}));
  pages.apply({{{1, 0}, Changes{{0, 1}}}, {{2, 1}, bytes({1})}});
  EXPECT_NE(pages.find({1, 0}), before.find({1, 0}));
  EXPECT_EQ(pages.find({1, 1}), before.find({1, 1}));
  EXPECT_EQ(pages.find({2, 0}), before.find({2, 0}));
  EXPECT_EQ(before.find({2, 1}), nullptr);
  EXPECT_EQ(std::get<Sums>(*before.find({1, 0}))[0], 1);
  EXPECT_EQ(before.hash(), hash);
}

TEST(StatePages, WhatCannotBeAppliedChangesNothing) {
  StatePages pages;
  pages.apply({{{1, 0}, Changes{{5, kMost - 1}}}, {{2, 0}, bytes({1})}});
  const StatePages before = pages;
  const std::pair<const char*, PageDelta> cases[] = {
      {"sum 5 of page 1.0", {{1, 0}, Changes{{5, 1}, {5, 1}}}},
      {"sum 5 of page 1.0", {{1, 0}, Changes{{5, kMost}}}},
      {"no sum 8192", {{1, 0}, Changes{{8192, 0}}}},
      {"no sum 65535", {{3, 0}, Changes{{65535, 1}}}},
      {"page 1.0 of a method's state holds sums", {{1, 0}, bytes({1})}},
      {"page 2.0 of a method's state holds records", {{2, 0}, Changes()}},
      {"65537 bytes", {{2, 0}, Records(kPageBytes + 1)}},
      {"65537 bytes", {{2, 1}, Records(kPageBytes + 1)}},
  };
  for (const auto& [part, wrong] : cases) {
    // Good changes before and after it are not made either.
    const PageDeltas deltas{
        {{1, 1}, Changes{{0, 9}}}, {{2, 0}, bytes({2})}, wrong, {{1, 0}, Changes{{0, 9}}}};
    const std::string text = errorOf([&] { pages.apply(deltas); });
    EXPECT_NE(text.find(part), std::string::npos) << part << ": " << text;
    expectSame(pages, before);
  }
  pages.apply({{{1, 0}, Changes{{5, 1}}}, {{2, 0}, Records(kPageBytes)}});
  EXPECT_EQ(std::get<Sums>(*pages.find({1, 0}))[5], kMost);
}

}  // namespace
}  // namespace ninefold
