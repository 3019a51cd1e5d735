// local_field.h: where all lines meet one instance.
//
//   page      the Runs of one (family, a, b, c), by rising d; pages of one slice follow each other
//   table     for each (family, a) the b's that meet the instance, and where their pages begin
//
// A line's hits are those of its page's runs that hold its d. Lines that miss cost nothing but
// their slice's share of the table. Triangles that are there twice are left out.
// (As published a run lasts while a line meets the same triangles, and each object has a field in
// its own frame. Here a run is of one triangle, and the frame is the scene's: after a move it is
// made again, so that no line is replaced by one near by.)
//
// A pure function of grid, mesh and place: all clients make the same one by themselves, sooner than
// it could be sent to them.
//
// Memory:  16 bytes a run, 4 a page.   Source: Ren et al. 2005, 4.3.
// Proved:  tests/gi/line_field_test.cpp.
// Threads: const after construction.   Errors: none; field_size.h tells before how large it is.
#pragma once

#include <span>
#include <vector>

#include "common/gi/intersection_field/scan_conversion.h"
#include "common/scene/scene.h"

namespace ninefold {

class LocalField {
 public:
  LocalField(const LineGrid& grid, const Mesh& mesh, const DMat4& toWorld);
  bool isOf(const LineGrid& grid, const Mesh& mesh, const DMat4& toWorld) const {
    return grid_ == grid && mesh_ == &mesh && toWorld_ == toWorld;
  }

  // The slices of (family, i) that meet it: first <= j < end.
  struct Slices {
    int first = 0, end = 0;
    uint32_t firstPage = 0;
  };
  const Slices& slices(int family, int i) const {
    return slices_[static_cast<size_t>(family * grid_.directions() + i)];
  }
  // Runs of one (family, i, j, k); none if the slice does not meet it.
  std::span<const LineRun> page(int family, int i, int j, int k) const;
  const std::vector<LineRun>& runs() const { return runs_; }
  uint64_t hits() const { return hits_; }  // of all lines
  // visit(line but for m, its first run, the end of its runs) for all pages that have one.
  template <typename Visit>
  void forEachPage(const Visit& visit) const;
  // visit(line but for m, run number) for all runs.
  template <typename Visit>
  void forEachRun(const Visit& visit) const {
    forEachPage([&](const GridLine& page, uint32_t first, uint32_t end) {
      for (uint32_t r = first; r < end; ++r) visit(page, r);
    });
  }

  size_t bytes() const { return sizeof(LineRun) * runs_.size() + sizeof(uint32_t) * pages_.size(); }

 private:
  uint32_t pageOf(const Slices& s, int j, int k) const {
    return s.firstPage + static_cast<uint32_t>((j - s.first) * 2 * grid_.directions() + k);
  }

  LineGrid grid_;
  const Mesh* mesh_;
  DMat4 toWorld_;
  std::vector<Slices> slices_;   // by family and i
  std::vector<uint32_t> pages_;  // where each page's runs begin, and the end
  std::vector<LineRun> runs_;
  uint64_t hits_ = 0;
};

template <typename Visit>
void LocalField::forEachPage(const Visit& visit) const {
  for (int family = 0; family < LineGrid::kFamilies; ++family)
    for (int i = 0; i < grid_.directions(); ++i) {
      const Slices& s = slices(family, i);
      for (int j = s.first; j < s.end; ++j)
        for (int k = 0; k < 2 * grid_.directions(); ++k) {
          const uint32_t page = pageOf(s, j, k);
          if (pages_[page] < pages_[page + 1])
            visit(GridLine{family, i, j, k, 0}, pages_[page], pages_[page + 1]);
        }
    }
}

// Corners of a mesh's triangles in a family's axes.
class FamilyCorners {
 public:
  FamilyCorners(const LineGrid& grid, int family, const Mesh& mesh, const DMat4& toWorld);
  std::array<Vec3, 3> of(const Triangle& t) const {
    return {vertices_[t.x], vertices_[t.y], vertices_[t.z]};
  }

 private:
  std::vector<Vec3> vertices_;
};

}  // namespace ninefold
