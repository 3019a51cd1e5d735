#include "common/gi/elements/photon_rows.h"

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

std::optional<PhotonRows::Header> headerOf(const Records& bytes) {
  if (bytes.size() < sizeof(PhotonRows::Header)) return std::nullopt;
  PhotonRows::Header header;
  std::memcpy(&header, bytes.data(), sizeof(header));
  if (!(header.lampFlux >= 0 && header.lampFlux < 1e30f)) return std::nullopt;
  return header;
}

bool arePossible(const PhotonRow& row) {
  return std::ranges::all_of(
      row.pilots, [](const Pilot& pilot) { return pilot.weight >= 0 && pilot.weight <= 1e6f; });
}

}  // namespace

PhotonRows::PhotonRows(uint32_t rows, size_t photons) : rows_(rows), photons_(photons) {
  const size_t wanted =
      sizeof(Header) + photons_ * (sizeof(Pilot) + kMostHitsOfPath * sizeof(ElementHit));
  const size_t most = std::min(kMostPages, kMostOfAll / rows_);
  pages_ = std::clamp<size_t>((wanted + kPageBytes - 1) / kPageBytes, 1, most);
}

size_t PhotonRows::room() const {
  const size_t bytes = pages_ * kPageBytes - sizeof(Header);
  const size_t pilots = photons_ * sizeof(Pilot);
  return bytes > pilots ? (bytes - pilots) / sizeof(ElementHit) : 0;
}

PageDeltas PhotonRows::replace(const StatePages& pages, uint32_t row,
                               const PhotonRow& content) const {
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

std::optional<PhotonRow> PhotonRows::read(const StatePages& pages, uint32_t row) const {
  Records bytes;
  for (size_t j = 0; j < pages_; ++j)
    if (const Records* page = recordsOf(pages, pageOf(row, j)))
      bytes.insert(bytes.end(), page->begin(), page->end());
  const std::optional<Header> header = headerOf(bytes);
  if (!header) return std::nullopt;
  const size_t length =
      sizeof(Header) + header->pilots * sizeof(Pilot) + header->hits * sizeof(ElementHit);
  if (bytes.size() != length) return std::nullopt;
  PhotonRow content{
      header->stamp, header->randomization, header->version, header->lampFlux, {}, {}};
  content.pilots.resize(header->pilots), content.hits.resize(header->hits);
  size_t place = sizeof(Header);
  take(bytes, place, content.pilots.data(), content.pilots.size());
  take(bytes, place, content.hits.data(), content.hits.size());
  if (!arePossible(content)) return std::nullopt;
  return content;
}

std::optional<PhotonRows::Header> PhotonRows::header(const StatePages& pages, uint32_t row) const {
  const Records* first = recordsOf(pages, pageOf(row, 0));
  return first == nullptr ? std::nullopt : headerOf(*first);
}

bool PhotonRows::isShared(const StatePages& a, const StatePages& b, uint32_t row) const {
  for (size_t j = 0; j < pages_; ++j)
    if (a.find(pageOf(row, j)) != b.find(pageOf(row, j))) return false;
  return true;
}

}  // namespace ninefold
