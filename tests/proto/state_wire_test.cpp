// Deltas and pages of a state on the wire: what comes back, what is refused, what it costs.
#include "proto/state_wire.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <random>
#include <string>

#include "common/state/state_pages.h"
#include "proto/compression.h"
#include "tests/seeds.h"

namespace ninefold {
namespace {

using Changes = std::vector<SumChange>;

std::string errorOf(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

Records randomRecords(std::mt19937_64& random, size_t size) {
  Records records(size);
  for (std::byte& b : records) b = static_cast<std::byte>(random());
  return records;
}

// Numbers of all lengths, of either sign, the ends among them.
int64_t randomAmount(std::mt19937_64& random) {
  const auto n = static_cast<int64_t>(random()) >> random() % 64;
  const int64_t ends[] = {std::numeric_limits<int64_t>::min(), std::numeric_limits<int64_t>::max()};
  return random() % 16 == 0 ? ends[random() % 2] : n;
}

// In some order, no place twice.
Changes randomChanges(std::mt19937_64& random, size_t count) {
  const size_t first = random(), step = random() | 1;
  Changes changes(count);
  for (size_t i = 0; i < count; ++i)
    changes[i] = {static_cast<uint16_t>((first + i * step) % kPageSums), randomAmount(random)};
  return changes;
}

PageDeltas randomDeltas(std::mt19937_64& random) {
  PageDeltas deltas;
  PageId id;
  for (size_t pages = random() % 9; pages > 0; --pages) {
    if (random() % 3 == 0) ++id.kind, id.index = static_cast<uint32_t>(random());
    ++id.index;
    if (!deltas.empty() && id <= deltas.back().page) continue;
    if (random() % 2 == 0)
      deltas.push_back({id, randomRecords(random, random() % 3000)});
    else
      deltas.push_back({id, randomChanges(random, random() % 300)});
  }
  return deltas;
}

TEST(StateWire, DeltasComeBackBitForBit) {
  for (const uint64_t seed : seedsFrom(1, 300)) {
    const Repeatable repeatable(seed);
    std::mt19937_64 random(seed);
    const PageDeltas deltas = randomDeltas(random);
    ASSERT_EQ(decodeDeltas(encodeDeltas(deltas)), deltas);
  }
}

TEST(StateWire, TheLeastAndTheMostComeBack) {
  std::mt19937_64 random(1);
  const PageId last{65535, ~0u};
  const PageDeltas cases[] = {
      {},
      {{{}, Records()}, {last, Changes()}},
      {{{}, randomRecords(random, kPageBytes)}, {last, randomChanges(random, kPageSums)}},
      {{{}, Changes{{8191, 1}, {0, 1}, {8191, -1}}}},  // any order, a place twice
  };
  for (const PageDeltas& deltas : cases) EXPECT_EQ(decodeDeltas(encodeDeltas(deltas)), deltas);
}

TEST(StateWire, WhatCouldNotBeDecodedIsNotEncoded) {
  const auto refusal = [](const PageDeltas& deltas) {
    return errorOf([&] { encodeDeltas(deltas); });
  };
  EXPECT_NE(refusal({{{2, 3}, Records(kPageBytes + 1)}}).find("page 2.3"), std::string::npos);
  EXPECT_NE(refusal({{{2, 3}, Changes(kPageSums + 1)}}).find("8193 changes"), std::string::npos);
  EXPECT_NE(refusal({{{2, 3}, Changes{{8192, 1}}}}).find("no sum 8192"), std::string::npos);
  EXPECT_NE(refusal({{{2, 3}, Records()}, {{2, 3}, Records()}}).find("twice"), std::string::npos);
  EXPECT_NE(refusal({{{2, 3}, Records()}, {{1, 9}, Records()}, {{2, 3}, Changes()}}).find("twice"),
            std::string::npos);
}

TEST(StateWire, PagesGoInTheOrderOfTheirIds) {
  const PageDelta first{{1, 9}, Records(3)}, second{{2, 3}, Changes{{4, 5}}};
  EXPECT_EQ(encodeDeltas({second, first}), encodeDeltas({first, second}));
  EXPECT_EQ(decodeDeltas(encodeDeltas({second, first})), (PageDeltas{first, second}));
}

TEST(StateWire, WhatIsTooMuchForAMessageIsRefused) {
  std::mt19937_64 random(1);
  PageDeltas noise, zeros, many(kMaxStatePages + 1);
  for (uint32_t i = 0; i < 40; ++i) noise.push_back({{1, i}, randomRecords(random, kPageBytes)});
  for (uint32_t i = 0; i < 260; ++i) zeros.push_back({{1, i}, Records(kPageBytes)});
  for (uint32_t i = 0; i < many.size(); ++i) many[i].page.index = i;
  for (const PageDeltas& deltas : {noise, zeros})
    EXPECT_NE(errorOf([&] { encodeDeltas(deltas); }).find("one message"), std::string::npos);
  EXPECT_NE(errorOf([&] { encodeDeltas(many); }).find("65536 pages"), std::string::npos);
}

// A deposit of light has some 30 bits that matter: five bytes of noise or less, and its place.
TEST(StateWire, SmallNumbersAreShort) {
  std::mt19937_64 random(1);
  Changes changes(4000);
  for (size_t i = 0; i < changes.size(); ++i)
    changes[i] = {static_cast<uint16_t>(2 * i),
                  static_cast<int64_t>(random() % (1 << 30)) - (1 << 29)};
  EXPECT_LT(encodeDeltas({{{1, 2}, changes}}).size(), 6 * changes.size());
  for (SumChange& change : changes) change.amount = change.amount > 0 ? 1 : -1;
  EXPECT_LT(encodeDeltas({{{1, 2}, changes}}).size(), changes.size());
}

Bytes encoded(const Bytes& raw, uint64_t size, uint8_t version = 1) {
  Bytes out;
  out.reserve(raw.size() + 100);
  ByteWriter writer(out);
  writer.number(version);
  writer.number(static_cast<uint32_t>(size));
  const Bytes compressed = compressBlob(raw, 1);
  writer.raw(compressed.data(), compressed.size());
  return out;
}

struct RawDelta {
  uint16_t kind = 1;
  uint32_t index = 2;
  uint8_t form = 0;
  uint32_t count = 0;
  size_t content = 0;  // bytes of 255
};

Bytes raw(const std::vector<RawDelta>& deltas) {
  Bytes out;
  out.reserve(1 << 20);
  ByteWriter writer(out);
  for (const RawDelta& d : deltas) {
    writer.number(d.kind), writer.number(d.index), writer.number(d.form), writer.number(d.count);
    const Bytes content(d.content, std::byte{255});
    writer.raw(content.data(), content.size());
  }
  return out;
}

TEST(StateWire, WrongDeltasAreNamed) {
  const auto refusal = [](const std::vector<RawDelta>& deltas) {
    const Bytes bytes = encoded(raw(deltas), raw(deltas).size());
    return errorOf([&] { decodeDeltas(bytes); });
  };
  EXPECT_EQ(refusal({{.count = 3, .content = 3}}), "");
  const std::pair<const char*, std::vector<RawDelta>> cases[] = {
      {"form 2", {{.form = 2}}},
      {"65537 bytes", {{.count = 65537, .content = 65537}}},
      {"8193 changes", {{.form = 1, .count = 8193, .content = 81930}}},
      {"4294967295 bytes", {{.count = ~0u}}},
      {"no sum 65535", {{.form = 1, .count = 1, .content = 10}}},
      {"claims 2 entries", {{.form = 1, .count = 2, .content = 19}}},
      {"claims 3 entries", {{.count = 3, .content = 2}}},
      {"ends inside", {{.count = 3, .content = 4}}},
      {"page 1.2", {{}, {}}},
      {"page 1.1", {{}, {.index = 1}}},
      {"page 0.9", {{}, {.kind = 0, .index = 9}}},
  };
  for (const auto& [part, deltas] : cases) {
    const std::string text = refusal(deltas);
    EXPECT_NE(text.find(part), std::string::npos) << part << ": " << text;
  }
  std::vector<RawDelta> many(kMaxStatePages + 1);
  for (uint32_t i = 0; i < many.size(); ++i) many[i].index = i;
  EXPECT_NE(refusal(many).find("65536 pages"), std::string::npos);
}

TEST(StateWire, LyingSizesAndVersionsAreRefused) {
  const Bytes good = raw({{.count = 3, .content = 3}});
  EXPECT_EQ(errorOf([&] { decodeDeltas(encoded(good, good.size())); }), "");
  for (const uint64_t size : {good.size() - 1, good.size() + 1, size_t{0}})
    EXPECT_NE(errorOf([&] { decodeDeltas(encoded(good, size)); }), "") << size;
  EXPECT_NE(errorOf([&] { decodeDeltas(encoded(good, kMaxRawDeltaBytes + 1)); }).find("at most"),
            std::string::npos);
  EXPECT_NE(errorOf([&] { decodeDeltas(encoded(good, good.size(), 2)); }).find("version 2"),
            std::string::npos);
  EXPECT_NE(errorOf([&] { decodeDeltas({}); }), "");
  // 256 MiB of zeros that claim to be 1000 bytes.
  const Bytes bomb(256 << 20, std::byte{0});
  EXPECT_NE(errorOf([&] { decodeDeltas(encoded(bomb, 1000)); }).find("damaged"), std::string::npos);
}

TEST(StateWire, EveryTruncationIsRefused) {
  std::mt19937_64 random(5);
  Bytes bytes =
      encodeDeltas({{{1, 2}, randomRecords(random, 100)}, {{1, 3}, randomChanges(random, 20)}});
  for (size_t size = 0; size < bytes.size(); ++size)
    ASSERT_THROW(decodeDeltas(ByteView(bytes).first(size)), Error) << size;
  const Bytes frame(bytes.begin() + 5, bytes.end());
  bytes.push_back(std::byte{0});
  EXPECT_THROW(decodeDeltas(bytes), Error) << "one byte too many";
  bytes.pop_back();
  const Bytes empty = compressBlob({}, 1);
  bytes.insert(bytes.end(), empty.begin(), empty.end());
  EXPECT_THROW(decodeDeltas(bytes), Error) << "one frame too many";
}

TEST(StateWire, DamageGivesAnErrorOrDeltasThatCanBeSentAgain) {
  for (const uint64_t seed : seedsFrom(1, 2000)) {
    const Repeatable repeatable(seed);
    std::mt19937_64 random(seed);
    const PageDeltas deltas = randomDeltas(random);
    Bytes bad = encodeDeltas(deltas);
    if (seed % 2 == 0) {  // inside the frame
      Bytes inside = decompressBlob(ByteView(bad).subspan(5), [&] {
        ByteReader in(ByteView(bad).subspan(1), "size");
        return in.number<uint32_t>("size");
      }());
      if (!inside.empty()) inside[random() % inside.size()] = static_cast<std::byte>(random());
      bad = encoded(inside, inside.size());
    } else {
      bad[random() % bad.size()] ^= static_cast<std::byte>(1 << random() % 8);
    }
    PageDeltas got;
    if (errorOf([&] { got = decodeDeltas(bad); }).empty()) {
      ASSERT_EQ(decodeDeltas(encodeDeltas(got)), got);
    }
  }
}

StatePage offerOf(PageId id, const Blob& blob) { return {id, blob.info}; }

TEST(StateWire, PagesComeBackBitForBit) {
  for (const uint64_t seed : seedsFrom(1, 60)) {
    const Repeatable repeatable(seed);
    std::mt19937_64 random(seed);
    StatePages pages;
    pages.apply(randomDeltas(random));
    StatePages late;
    for (const auto& [id, page] : pages.all()) {
      const Blob blob = packPage(id, *page);
      ASSERT_EQ(blob.info.kind, BlobKind::page);
      ASSERT_LE(blob.info.rawBytes, kMaxPageBlobBytes);
      const PageDelta delta = unpackPage(offerOf(id, blob), blob.compressed);
      late.apply({delta});
      ASSERT_EQ(*late.find(id), *page);
    }
    EXPECT_EQ(late.hash(), pages.hash());
  }
}

TEST(StateWire, TheLargestPagesFit) {
  const Blob records = packPage({1, 2}, Records(kPageBytes, std::byte{7}));
  EXPECT_EQ(std::get<Records>(unpackPage(offerOf({1, 2}, records), records.compressed).change),
            Records(kPageBytes, std::byte{7}));
  const Blob sums = packPage({1, 2}, Sums(kPageSums, std::numeric_limits<int64_t>::min()));
  EXPECT_EQ(sums.info.rawBytes, kMaxPageBlobBytes);
  StatePages pages;
  pages.apply({unpackPage(offerOf({1, 2}, sums), sums.compressed)});
  EXPECT_EQ(std::get<Sums>(*pages.find({1, 2})).back(), std::numeric_limits<int64_t>::min());
}

// A page has one name, whatever led to it; another page with the same content has another.
TEST(StateWire, APageIsNamedByWhatItIs) {
  StatePages once, twice;
  once.apply({{{1, 2}, Changes{{3, 5}}}});
  twice.apply({{{1, 2}, Changes{{3, 7}, {4, 1}}}});
  twice.apply({{{1, 2}, Changes{{4, -1}, {3, -2}}}});
  const auto name = [](PageId id, const StatePages& pages) {
    return packPage(id, *pages.find({1, 2})).info.hash;
  };
  EXPECT_EQ(name({1, 2}, once), name({1, 2}, twice));
  EXPECT_NE(name({1, 2}, once), name({1, 3}, once));
  EXPECT_NE(name({1, 2}, once), name({2, 2}, once));
}

TEST(StateWire, PagesThatWereNotOfferedAreRefused) {
  const Blob blob = packPage({1, 2}, Records(100, std::byte{7}));
  const auto refusal = [&](StatePage offered) {
    return errorOf([&] { unpackPage(offered, blob.compressed); });
  };
  StatePage offered = offerOf({1, 2}, blob);
  EXPECT_EQ(refusal(offered), "");
  EXPECT_NE(refusal(offerOf({1, 3}, blob)).find("1.3 was offered"), std::string::npos);
  EXPECT_NE(refusal(offerOf({2, 2}, blob)).find("2.2 was offered"), std::string::npos);
  offered.blob.hash[3] ^= 1;
  EXPECT_NE(refusal(offered).find("SHA-256"), std::string::npos);
  offered = offerOf({1, 2}, blob), --offered.blob.rawBytes;
  EXPECT_NE(refusal(offered).find("state page"), std::string::npos);
  offered.blob.rawBytes = kMaxPageBlobBytes + 1;
  EXPECT_NE(refusal(offered).find("at most"), std::string::npos);
  const auto unpacked = [](const Bytes& raw) {
    return unpackPage({{1, 2}, {sha256(raw), raw.size(), BlobKind::page}}, compressBlob(raw, 1));
  };
  EXPECT_EQ(unpacked(raw({{}})), (PageDelta{{1, 2}, Records()}));
  EXPECT_THROW(unpacked(raw({{}, {.index = 3}})), Error) << "two";
  EXPECT_THROW(unpacked({}), Error);
}

}  // namespace
}  // namespace ninefold
