#include "common/gi/photon_map/map_photon.h"

#include <algorithm>
#include <cstring>

namespace ninefold {
namespace {

Records recordsOf(const MapPhoton* photons, size_t count) {
  Records bytes(count * sizeof(MapPhoton));
  if (count > 0) std::memcpy(bytes.data(), photons, bytes.size());
  return bytes;
}

}  // namespace

PageDeltas MapLayout::replace(const StatePages& pages, uint32_t part,
                              const std::vector<MapPhoton>& photons) const {
  PageDeltas deltas;
  for (size_t j = 0; j < pages_; ++j) {
    const PageId id{0, static_cast<uint32_t>(part * pages_ + j)};
    const size_t first = std::min(j * kPerPage, photons.size());
    const size_t count = std::min(kPerPage, photons.size() - first);
    // A page that was never needed stays unwritten.
    if (count > 0 || pages.find(id) != nullptr)
      deltas.push_back({id, recordsOf(photons.data() + first, count)});
  }
  return deltas;
}

std::vector<MapPhoton> readPhotons(const StatePages& pages) {
  std::vector<MapPhoton> photons;
  for (const auto& [id, page] : pages.all()) {
    const auto* bytes = std::get_if<Records>(page.get());
    if (bytes == nullptr || bytes->empty()) continue;
    const size_t count = bytes->size() / sizeof(MapPhoton), first = photons.size();
    photons.resize(first + count);
    std::memcpy(static_cast<void*>(photons.data() + first), bytes->data(),
                count * sizeof(MapPhoton));
  }
  return photons;
}

}  // namespace ninefold
