// photon_rows.h: the pages of a state that keeps what photons hit, row by row.
//
//   kind 1, records   pages r J + j, j in [0, J): row r as bytes, cut into pages: a header, its
//                     Pilots if it has any, its ElementHits in the order of its photons
//
// A row that is traced again is replaced. So what its photons left before is taken away without
// tracing them a second time in the scene that was: light is the sum over the rows.
// A hit names triangle and place; which elements lie there is for who reads it (element_light.h).
//
// Proved:  tests/gi/group_pages_test.cpp.
// Threads: pure functions.
// Errors:  rows that are cut short or have impossible numbers read as never traced.
// Memory:  12 bytes a hit, 12 a pilot.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/state/state_pages.h"

namespace ninefold {

// Flux that a photon leaves in elements.
struct ElementHit {
  uint32_t surface = 0;   // 2 (number of the triangle among all of the scene) + 1 on its back
  uint16_t u = 0, v = 0;  // barycentrics in 1/65535
  uint32_t flux = 0;      // packed_flux.h [W]
  bool operator==(const ElementHit&) const = default;
};
static_assert(sizeof(ElementHit) == 12);

// A photon whose path tells what an edit has changed (selective/photon_groups.h).
struct Pilot {
  uint32_t signature = 0;  // hash of its hits
  float weight = 0;        // P that a change of its path adds to the group that it is like
  uint32_t end = 0;        // its hits end before this one
  bool operator==(const Pilot&) const = default;
};

// What the photons of one row left.
struct PhotonRow {
  uint64_t stamp = 0;          // of the scene that it was traced in (scene_stamp.h)
  uint32_t randomization = 0;  // replication of its numbers
  uint32_t version = 0;        // of the state that it was made for: tells which is older
  float lampFlux = 0;          // of all lamps then [W]
  std::vector<Pilot> pilots;
  std::vector<ElementHit> hits;
  bool operator==(const PhotonRow&) const = default;
};

class PhotonRows {
 public:
  // photons: most of a row.
  PhotonRows(uint32_t rows, size_t photons);
  bool operator==(const PhotonRows&) const = default;

  uint32_t count() const { return rows_; }
  // Hits that there is room for in a row, whose photons are all pilots.
  size_t room() const;
  PageDeltas replace(const StatePages& pages, uint32_t row, const PhotonRow& content) const;
  // Nothing: it was never traced.
  std::optional<PhotonRow> read(const StatePages& pages, uint32_t row) const;
  // What stands before its pilots and hits.
  struct Header {
    uint64_t stamp;
    uint32_t randomization, version;
    float lampFlux;
    uint32_t pilots, hits;
    uint32_t unused = 0;  // no byte of a page is left to chance
  };
  std::optional<Header> header(const StatePages& pages, uint32_t row) const;
  // The row's pages are the same ones in both.
  bool isShared(const StatePages& a, const StatePages& b, uint32_t row) const;

 private:
  PageId pageOf(uint32_t row, size_t j) const {
    return {1, static_cast<uint32_t>(row * pages_ + j)};
  }
  uint32_t rows_;
  size_t photons_;  // most of a row
  size_t pages_;    // J
};

}  // namespace ninefold
