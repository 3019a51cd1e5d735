#include "proto/state_wire.h"

#include <zstd.h>

#include <algorithm>
#include <optional>
#include <span>

#include "proto/compression.h"

namespace ninefold {
namespace {

constexpr uint8_t kVersion = 1;
constexpr size_t kHeadBytes = 1 + 4;
constexpr int kLevel = 3;
constexpr size_t kPartBytes = 512 << 10;  // before compression; so that heartbeats slip in between
enum Form : uint8_t { kRecords = 0, kSums = 1 };

struct Head {
  PageId page;
  uint8_t form;
  size_t count;  // of bytes or changes
};

size_t bytesEach(uint8_t form) { return form == kSums ? sizeof(uint16_t) + sizeof(int64_t) : 1; }

Head headOf(const PageDelta& delta) {
  const auto* records = std::get_if<Records>(&delta.change);
  if (records != nullptr) return {delta.page, kRecords, records->size()};
  return {delta.page, kSums, std::get<std::vector<SumChange>>(delta.change).size()};
}

size_t rawBytes(const PageDelta& delta) {
  const Head head = headOf(delta);
  return kDeltaHeadBytes + head.count * bytesEach(head.form);
}

void check(const Head& head) {
  const auto& [page, form, count] = head;
  if (form > kSums) fail("page {}.{} of a state: form {} is unknown", page.kind, page.index, form);
  const size_t most = form == kSums ? kPageSums : kPageBytes;
  if (count > most)
    fail("page {}.{} of a state: {} {}, at most {} are allowed", page.kind, page.index, count,
         form == kSums ? "changes" : "bytes", most);
}

void checkPlace(PageId page, size_t place) {
  if (place >= kPageSums) fail("page {}.{} of a state has no sum {}", page.kind, page.index, place);
}

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

// So that small numbers of either sign have bytes of 0: 0, -1, 1, -2, ... to 0, 1, 2, 3, ...
uint64_t folded(int64_t n) {
  return static_cast<uint64_t>(n) << 1 ^ static_cast<uint64_t>(n >> 63);
}
int64_t unfolded(uint64_t n) { return static_cast<int64_t>(n >> 1 ^ (~(n & 1) + 1)); }

// The lowest byte of each number, then the next of each.
template <typename Unsigned, typename NumberOf>
void writePlanes(size_t count, const NumberOf& numberOf, ByteWriter& writer) {
  Bytes plane(count);
  for (size_t b = 0; b < sizeof(Unsigned); ++b) {
    for (size_t i = 0; i < count; ++i)
      plane[i] = static_cast<std::byte>(static_cast<Unsigned>(numberOf(i)) >> 8 * b);
    writer.raw(plane.data(), plane.size());
  }
}

template <typename Unsigned>
std::vector<Unsigned> readPlanes(size_t count, const char* field, ByteReader& in) {
  std::vector<Unsigned> numbers(count);
  for (size_t b = 0; b < sizeof(Unsigned); ++b) {
    const ByteView plane = in.take(count, field);
    for (size_t i = 0; i < count; ++i)
      numbers[i] = static_cast<Unsigned>(numbers[i] | static_cast<Unsigned>(plane[i]) << 8 * b);
  }
  return numbers;
}

void writeChanges(PageId page, const std::vector<SumChange>& changes, ByteWriter& writer) {
  for (const SumChange& change : changes) checkPlace(page, change.place);
  const auto placeBefore = [&](size_t i) { return i == 0 ? 0 : changes[i - 1].place; };
  writePlanes<uint16_t>(
      changes.size(), [&](size_t i) { return changes[i].place - placeBefore(i); }, writer);
  writePlanes<uint64_t>(
      changes.size(), [&](size_t i) { return folded(changes[i].amount); }, writer);
}

std::vector<SumChange> readChanges(PageId page, size_t count, ByteReader& in) {
  const std::vector<uint16_t> steps = readPlanes<uint16_t>(count, "places", in);
  const std::vector<uint64_t> amounts = readPlanes<uint64_t>(count, "amounts", in);
  std::vector<SumChange> changes(count);
  uint16_t place = 0;
  for (size_t i = 0; i < count; ++i) {
    place = static_cast<uint16_t>(place + steps[i]);
    checkPlace(page, place);
    changes[i] = {place, unfolded(amounts[i])};
  }
  return changes;
}

void write(const PageDelta& delta, Bytes& out) {
  const Head head = headOf(delta);
  check(head);
  ByteWriter writer(out);
  writer.number(head.page.kind);
  writer.number(head.page.index);
  writer.number(head.form);
  writer.number(static_cast<uint32_t>(head.count));
  if (const auto* records = std::get_if<Records>(&delta.change))
    writer.raw(records->data(), records->size());
  else
    writeChanges(head.page, std::get<std::vector<SumChange>>(delta.change), writer);
}

PageDelta read(ByteReader& in) {
  Head head{};
  head.page.kind = in.number<uint16_t>("page kind");
  head.page.index = in.number<uint32_t>("page index");
  head.form = in.number<uint8_t>("form");
  head.count = in.number<uint32_t>("count");
  check(head);
  const size_t count = in.count(head.count, bytesEach(head.form), "page");
  if (head.form == kSums) return {head.page, readChanges(head.page, count, in)};
  const ByteView records = in.take(count, "records");
  return {head.page, Records(records.begin(), records.end())};
}

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

using DeltaViews = std::vector<const PageDelta*>;

DeltaViews byPage(const PageDeltas& deltas) {
  DeltaViews views;
  for (const PageDelta& delta : deltas) views.push_back(&delta);
  std::ranges::stable_sort(views, {}, [](const PageDelta* delta) { return delta->page; });
  return views;
}

Bytes encode(std::span<const PageDelta* const> deltas) {
  Bytes raw;
  Order order;
  for (const PageDelta* delta : deltas) {
    order.next(delta->page);
    write(*delta, raw);
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

Bytes encodeDeltas(const PageDeltas& deltas) { return encode(byPage(deltas)); }

PageDeltas decodeDeltas(ByteView encoded) {
  ByteReader in(encoded, "state deltas");
  if (const auto version = in.number<uint8_t>("version"); version != kVersion)
    fail("state deltas: version {} is unknown", version);
  const auto size = in.number<uint32_t>("size");
  const Bytes raw = decompressed(in.take(in.left(), "body"), size);
  ByteReader body(raw, "state deltas");
  Order order;
  PageDeltas deltas;
  while (body.left() > 0) {
    deltas.push_back(read(body));
    order.next(deltas.back().page);
  }
  return deltas;
}

std::vector<Bytes> encodeParts(const PageDeltas& deltas) {
  std::vector<Bytes> parts;
  const DeltaViews all = byPage(deltas);
  std::span left(all);
  do {
    size_t count = 0;
    for (size_t bytes = 0; count < left.size(); ++count) {
      bytes += rawBytes(*left[count]);
      if (count > 0 && (bytes > kPartBytes || count == kMaxStatePages)) break;
    }
    parts.push_back(encode(left.first(count)));
    left = left.subspan(count);
  } while (!left.empty());
  return parts;
}

Blob packPage(PageId id, const Page& page) {
  Bytes raw;
  write(deltaTo(id, page), raw);
  return {{sha256(raw), raw.size(), BlobKind::page}, compressBlob(raw, kLevel)};
}

PageDelta unpackPage(const StatePage& offered, ByteView compressed) {
  if (offered.blob.rawBytes > kMaxPageBlobBytes)
    fail("state page: declares {} bytes, at most {} are allowed", offered.blob.rawBytes,
         kMaxPageBlobBytes);
  return readPage(offered.page, unpackBlob(offered.blob, compressed));
}

PageDelta readPage(PageId offered, ByteView raw) {
  ByteReader in(raw, "state page");
  PageDelta delta = read(in);
  in.expectEnd();
  if (delta.page != offered)
    fail("state page: is page {}.{}, {}.{} was offered", delta.page.kind, delta.page.index,
         offered.kind, offered.index);
  return delta;
}

}  // namespace ninefold
