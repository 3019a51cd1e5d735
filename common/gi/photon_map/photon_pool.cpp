#include "common/gi/photon_map/photon_pool.h"

namespace ninefold {

PhotonPool::PhotonPool(std::vector<MapPhoton> photons, MapIndex index)
    : photons_(std::move(photons)) {
  std::vector<NamedPoint> points;
  points.reserve(photons_.size());
  for (size_t i = 0; i < photons_.size(); ++i)
    points.push_back({photons_[i].position, static_cast<uint32_t>(i)});
  if (index == MapIndex::tree)
    index_ = PhotonTree(std::move(points));
  else
    index_ = PhotonCells(points);
}

}  // namespace ninefold
