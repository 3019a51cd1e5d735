// Any bytes as encoded deltas, as deltas before compression, and as a page: deltas that can be
// applied or an Error, and what was understood can be said again and means the same.
#include "proto/state_wire.h"

#include "common/state/state_pages.h"
#include "proto/compression.h"
#include "tests/fuzz/fuzz.h"

namespace ninefold {
namespace {

constexpr size_t kHeadBytes = 5;  // version, size

void decode(ByteView bytes) {
  try {
    const PageDeltas deltas = decodeDeltas(bytes);
    NINEFOLD_CHECK(decodeDeltas(encodeDeltas(deltas)) == deltas);
    StatePages().apply(deltas);
  } catch (const Error&) {
  }
}

// As if they had been compressed, so that changes reach what lies inside.
void decodeInside(ByteView bytes) {
  Bytes encoded;
  encoded.reserve(kHeadBytes);
  ByteWriter writer(encoded);
  writer.number(uint8_t{1});
  writer.number(static_cast<uint32_t>(bytes.size()));
  const Bytes compressed = compressBlob(bytes, 1);
  encoded.insert(encoded.end(), compressed.begin(), compressed.end());
  decode(encoded);
}

void decodePage(ByteView bytes) {
  try {
    const BlobInfo info{sha256(bytes), bytes.size(), BlobKind::page};
    const PageDelta delta = unpackPage({{1, 2}, info}, compressBlob(bytes, 1));
    NINEFOLD_CHECK(decodeDeltas(encodeDeltas({delta})) == PageDeltas{delta});
    StatePages pages;
    pages.apply({delta});
    const Blob blob = packPage(delta.page, *pages.find(delta.page));
    unpackPage({delta.page, blob.info}, blob.compressed);
  } catch (const Error&) {
  }
}

std::vector<uint8_t> seedOf(uint8_t choice, ByteView bytes) {
  std::vector<uint8_t> seed{choice};
  for (const std::byte b : bytes) seed.push_back(static_cast<uint8_t>(b));
  return seed;
}

}  // namespace
}  // namespace ninefold

std::vector<std::vector<uint8_t>> ninefoldFuzzSeeds() {
  using namespace ninefold;
  const std::vector<SumChange> changes{{0, 1}, {8191, -1}, {77, 1ll << 40}};
  const Records records(30, std::byte{5});
  const Bytes encoded = encodeDeltas({{{1, 2}, records}, {{1, 3}, Records()}, {{4, 0}, changes}});
  ByteReader size(ByteView(encoded).subspan(1), "size");
  const Bytes inside =
      decompressBlob(ByteView(encoded).subspan(kHeadBytes), size.number<uint32_t>("size"));
  Sums sums(kPageSums, 0);
  sums[5] = -3, sums[8191] = 1ll << 50;
  const Blob pages[] = {packPage({1, 2}, records), packPage({1, 2}, sums)};
  return {seedOf(0, encoded), seedOf(1, inside),
          seedOf(2, unpackBlob(pages[0].info, pages[0].compressed)),
          seedOf(2, unpackBlob(pages[1].info, pages[1].compressed))};
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace ninefold;
  if (size == 0) return 0;
  const ByteView bytes = std::as_bytes(std::span(data + 1, size - 1));
  if (data[0] % 3 == 0) decode(bytes);
  if (data[0] % 3 == 1) decodeInside(bytes);
  if (data[0] % 3 == 2) decodePage(bytes);
  return 0;
}
