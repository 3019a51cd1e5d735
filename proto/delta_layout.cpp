#include "proto/delta_layout.h"

namespace ninefold {
namespace {

enum Form : uint8_t { kRecords = 0, kSums = 1 };

struct Head {
  PageId page;
  uint8_t form;
  size_t count;  // of bytes or changes
};

size_t bytesEach(uint8_t form) { return form == kSums ? kChangeBytes : 1; }

Head headOf(const PageDelta& delta) {
  const auto* records = std::get_if<Records>(&delta.change);
  if (records != nullptr) return {delta.page, kRecords, records->size()};
  return {delta.page, kSums, std::get<std::vector<SumChange>>(delta.change).size()};
}

void checkHead(const Head& head) {
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

}  // namespace

void writeDelta(const PageDelta& delta, Bytes& out) {
  const Head head = headOf(delta);
  checkHead(head);
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

PageDelta readDelta(ByteReader& in) {
  Head head{};
  head.page.kind = in.number<uint16_t>("page kind");
  head.page.index = in.number<uint32_t>("page index");
  head.form = in.number<uint8_t>("form");
  head.count = in.number<uint32_t>("count");
  checkHead(head);
  const size_t count = in.count(head.count, bytesEach(head.form), "page");
  if (head.form == kSums) return {head.page, readChanges(head.page, count, in)};
  const ByteView records = in.take(count, "records");
  return {head.page, Records(records.begin(), records.end())};
}

}  // namespace ninefold
