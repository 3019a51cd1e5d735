// photon_pool.h: the hits of one version of the state, ready to be found by place.
//
// Index: photon_cells.h or photon_tree.h (--map-index). Both find the same, so that it decides
// about time alone. Photons are named by their place in page order.
//
// Threads: const after construction.   Errors: none.
#pragma once

#include <variant>

#include "common/gi/photon_map/map_photon.h"
#include "common/gi/photon_map/photon_cells.h"
#include "common/gi/photon_map/photon_tree.h"

namespace ninefold {

class PhotonPool {
 public:
  PhotonPool(std::vector<MapPhoton> photons, MapIndex index);

  const std::vector<MapPhoton>& photons() const { return photons_; }
  const MapPhoton& operator[](uint32_t name) const { return photons_[name]; }

  // As PhotonTree::near.
  template <typename Visit>
  void near(Vec3 x, float r2, Visit&& visit) const {
    std::visit([&](const auto& index) { index.near(x, r2, visit); }, index_);
  }

 private:
  std::vector<MapPhoton> photons_;
  std::variant<PhotonCells, PhotonTree> index_;
};

}  // namespace ninefold
