#include "common/gi/selective/group_pages.h"

#include <algorithm>
#include <cstring>

namespace ninefold {
namespace {

constexpr size_t kMostPages = 30;       // of a row: what can be sent at once, 2 MiB
constexpr size_t kMostOfAll = 60000;    // of the state (proto allows some more)
constexpr size_t kMostHitsOfPath = 64;  // mean number that there is room for, if there is

template <typename T>
void append(Records& bytes, const T* values, size_t count) {
  const size_t before = bytes.size();
  bytes.resize(before + count * sizeof(T));
  if (count > 0) std::memcpy(bytes.data() + before, values, count * sizeof(T));
}

template <typename T>
void take(const Records& bytes, size_t& place, T* values, size_t count) {
  if (count > 0) std::memcpy(values, bytes.data() + place, count * sizeof(T));
  place += count * sizeof(T);
}

const Records* recordsOf(const StatePages& pages, PageId id) {
  const Page* page = pages.find(id);
  return page == nullptr ? nullptr : std::get_if<Records>(page);
}

std::optional<GroupPages::Header> headerOf(const Records& bytes) {
  if (bytes.size() < sizeof(GroupPages::Header)) return std::nullopt;
  GroupPages::Header header;
  std::memcpy(&header, bytes.data(), sizeof(header));
  if (!(header.lampFlux >= 0 && header.lampFlux < 1e30f)) return std::nullopt;
  return header;
}

bool arePossible(const GroupRow& row) {
  return std::ranges::all_of(
      row.pilots, [](const Pilot& pilot) { return pilot.weight >= 0 && pilot.weight <= 1e6f; });
}

}  // namespace

GroupPages::GroupPages(const PhotonGroups& groups)
    : photons_(std::max(groups.photonsOf(0), groups.photonsOf(groups.groups()))) {
  const size_t wanted =
      sizeof(Header) + photons_ * (sizeof(Pilot) + kMostHitsOfPath * sizeof(ElementHit));
  const size_t most = std::min(kMostPages, kMostOfAll / groups.rows());
  pages_ = std::clamp<size_t>((wanted + kPageBytes - 1) / kPageBytes, 1, most);
}

size_t GroupPages::room() const {
  const size_t bytes = pages_ * kPageBytes - sizeof(Header);
  const size_t pilots = photons_ * sizeof(Pilot);
  return bytes > pilots ? (bytes - pilots) / sizeof(ElementHit) : 0;
}

PageDeltas GroupPages::replace(const StatePages& pages, uint32_t row,
                               const GroupRow& content) const {
  Records bytes;
  const Header header{content.stamp,
                      content.randomization,
                      content.version,
                      content.lampFlux,
                      static_cast<uint32_t>(content.pilots.size()),
                      static_cast<uint32_t>(content.hits.size())};
  append(bytes, &header, 1);
  append(bytes, content.pilots.data(), content.pilots.size());
  append(bytes, content.hits.data(), content.hits.size());
  PageDeltas deltas;
  for (size_t j = 0; j < pages_; ++j) {
    const auto from = static_cast<std::ptrdiff_t>(std::min(j * kPageBytes, bytes.size()));
    const auto to = static_cast<std::ptrdiff_t>(std::min((j + 1) * kPageBytes, bytes.size()));
    const PageId id = pageOf(row, j);
    // A page that was never needed stays unwritten.
    if (from < to || pages.find(id) != nullptr)
      deltas.push_back({id, Records(bytes.begin() + from, bytes.begin() + to)});
  }
  return deltas;
}

std::optional<GroupRow> GroupPages::read(const StatePages& pages, uint32_t row) const {
  Records bytes;
  for (size_t j = 0; j < pages_; ++j)
    if (const Records* page = recordsOf(pages, pageOf(row, j)))
      bytes.insert(bytes.end(), page->begin(), page->end());
  const std::optional<Header> header = headerOf(bytes);
  if (!header) return std::nullopt;
  const size_t length =
      sizeof(Header) + header->pilots * sizeof(Pilot) + header->hits * sizeof(ElementHit);
  if (bytes.size() != length) return std::nullopt;
  GroupRow content{header->stamp, header->randomization, header->version, header->lampFlux, {}, {}};
  content.pilots.resize(header->pilots), content.hits.resize(header->hits);
  size_t place = sizeof(Header);
  take(bytes, place, content.pilots.data(), content.pilots.size());
  take(bytes, place, content.hits.data(), content.hits.size());
  if (!arePossible(content)) return std::nullopt;
  return content;
}

std::optional<GroupPages::Header> GroupPages::header(const StatePages& pages, uint32_t row) const {
  const Records* first = recordsOf(pages, pageOf(row, 0));
  return first == nullptr ? std::nullopt : headerOf(*first);
}

bool GroupPages::isShared(const StatePages& a, const StatePages& b, uint32_t row) const {
  for (size_t j = 0; j < pages_; ++j)
    if (a.find(pageOf(row, j)) != b.find(pageOf(row, j))) return false;
  return true;
}

int64_t GroupPages::priority(const StatePages& pages, uint32_t group) {
  const Page* page = pages.find({0, static_cast<uint32_t>(group / kPageSums)});
  const auto* sums = page == nullptr ? nullptr : std::get_if<Sums>(page);
  return sums == nullptr ? 0 : (*sums)[group % kPageSums];
}

void GroupPages::addPriorities(const std::vector<int64_t>& amounts, PageDeltas& deltas) {
  for (size_t first = 0; first < amounts.size(); first += kPageSums) {
    std::vector<SumChange> changes;
    for (size_t g = first; g < std::min(first + kPageSums, amounts.size()); ++g)
      if (amounts[g] != 0) changes.push_back({static_cast<uint16_t>(g - first), amounts[g]});
    if (!changes.empty())
      deltas.push_back({{0, static_cast<uint32_t>(first / kPageSums)}, std::move(changes)});
  }
}

}  // namespace ninefold
