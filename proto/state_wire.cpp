#include "proto/state_wire.h"

#include <zstd.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "proto/compression.h"
#include "proto/delta_layout.h"

namespace ninefold {
namespace {

constexpr uint8_t kVersion = 1;
constexpr size_t kHeadBytes = 1 + 4;
constexpr int kLevel = 1;

// Of pages that follow one another, and how many there are.
class Order {
 public:
  void next(PageId page) {
    if (last_ && page <= *last_)
      fail("page {}.{} of a state is out of order or there twice", page.kind, page.index);
    if (++count_ > kMaxStatePages) fail("state: changes more than {} pages", kMaxStatePages);
    last_ = page;
  }

 private:
  std::optional<PageId> last_;
  size_t count_ = 0;
};

Bytes decompressed(ByteView compressed, size_t size) {
  if (size > kMaxRawDeltaBytes)
    fail("state deltas: declare {} bytes, at most {} are allowed", size, kMaxRawDeltaBytes);
  Bytes raw(size);
  const size_t frame = ZSTD_findFrameCompressedSize(compressed.data(), compressed.size());
  const size_t got = ZSTD_decompress(raw.data(), size, compressed.data(), compressed.size());
  if (frame != compressed.size() || ZSTD_isError(got) != 0 || got != size)
    fail("state deltas: compressed data is damaged");
  return raw;
}

Bytes rawDeltas(ByteView encoded) {
  ByteReader in(encoded, "state deltas");
  if (const auto version = in.number<uint8_t>("version"); version != kVersion)
    fail("state deltas: version {} is unknown", version);
  const auto size = in.number<uint32_t>("size");
  return decompressed(in.take(in.left(), "body"), size);
}

std::vector<const PageDelta*> byPage(const PageDeltas& deltas) {
  std::vector<const PageDelta*> views;
  for (const PageDelta& delta : deltas) views.push_back(&delta);
  std::ranges::sort(views, {}, [](const PageDelta* delta) { return delta->page; });
  return views;
}

// What makes the page of nothing.
PageDelta deltaTo(PageId id, const Page& page) {
  if (const auto* records = std::get_if<Records>(&page)) return {id, *records};
  const Sums& sums = std::get<Sums>(page);
  std::vector<SumChange> changes;
  for (size_t place = 0; place < sums.size(); ++place)
    if (sums[place] != 0) changes.push_back({static_cast<uint16_t>(place), sums[place]});
  return {id, std::move(changes)};
}

}  // namespace

Bytes encodeDeltas(const PageDeltas& deltas) {
  Bytes raw;
  Order order;
  for (const PageDelta* delta : byPage(deltas)) {
    order.next(delta->page);
    writeDelta(*delta, raw);
    if (raw.size() > kMaxRawDeltaBytes)
      fail("state deltas: more than {} bytes for one message", kMaxRawDeltaBytes);
  }
  const Bytes compressed = compressBlob(raw, kLevel);
  Bytes out;
  out.reserve(kHeadBytes + compressed.size());
  ByteWriter writer(out);
  writer.number(kVersion);
  writer.number(static_cast<uint32_t>(raw.size()));
  writer.raw(compressed.data(), compressed.size());
  if (out.size() > kMaxDeltaBytes)
    fail("state deltas: take {} bytes, at most {} can be sent in one message", out.size(),
         kMaxDeltaBytes);
  return out;
}

PageDeltas decodeDeltas(ByteView encoded) {
  const Bytes raw = rawDeltas(encoded);
  ByteReader body(raw, "state deltas");
  Order order;
  PageDeltas deltas;
  while (body.left() > 0) {
    deltas.push_back(readDelta(body));
    order.next(deltas.back().page);
  }
  return deltas;
}

Sha256 digestOfDeltas(ByteView encoded) { return sha256(rawDeltas(encoded)); }

Blob packPage(PageId id, const Page& page) {
  Bytes raw;
  writeDelta(deltaTo(id, page), raw);
  return {{sha256(raw), raw.size(), BlobKind::page}, compressBlob(raw, kLevel)};
}

PageDelta unpackPage(const StatePage& offered, ByteView compressed) {
  if (offered.blob.rawBytes > kMaxPageBlobBytes)
    fail("state page: declares {} bytes, at most {} are allowed", offered.blob.rawBytes,
         kMaxPageBlobBytes);
  const Bytes raw = unpackBlob(offered.blob, compressed);
  ByteReader in(raw, "state page");
  PageDelta delta = readDelta(in);
  in.expectEnd();
  if (delta.page != offered.page)
    fail("state page: is page {}.{}, {}.{} was offered", delta.page.kind, delta.page.index,
         offered.page.kind, offered.page.index);
  return delta;
}

}  // namespace ninefold
