#include "common/gi/intersection_field/local_field.h"

#include <algorithm>

#include "common/gi/elements/twins.h"
#include "common/scene/world.h"

namespace ninefold {
namespace {

// A run, and its page among those of one (family, i), counted from slice 0.
struct PlacedRun {
  uint32_t page;
  LineRun run;
};

}  // namespace

FamilyCorners::FamilyCorners(const LineGrid& grid, int family, const Mesh& mesh,
                             const DMat4& toWorld) {
  vertices_.reserve(mesh.positions.size());
  for (const Vec3& p : mesh.positions)
    vertices_.push_back(grid.toFamily(family, worldPoint(toWorld, p)));
}

LocalField::LocalField(const LineGrid& grid, const Mesh& mesh, const DMat4& toWorld)
    : grid_(grid), mesh_(&mesh), toWorld_(toWorld), pages_{0} {
  const Twins twins(mesh);
  const int n = grid.directions();
  std::array<LineRun, 2 * LineGrid::kMostDirections> runs;
  std::vector<PlacedRun> found;
  for (int family = 0; family < LineGrid::kFamilies; ++family) {
    const FamilyCorners corners(grid, family, mesh, toWorld);
    for (int i = 0; i < n; ++i) {
      found.clear();
      Slices slices{grid.distances(), 0, static_cast<uint32_t>(pages_.size() - 1)};
      for (uint32_t k = 0; k < mesh.triangles.size(); ++k) {
        if (twins.find(k) != nullptr) continue;
        const SlicedTriangle triangle(grid, family, i, corners.of(mesh.triangles[k]));
        for (int j = triangle.first(grid); j < triangle.end(grid); ++j) {
          runsOf(grid, family, segmentOf(triangle, j), k, runs);
          slices.first = std::min(slices.first, j), slices.end = std::max(slices.end, j + 1);
          const auto page = static_cast<uint32_t>(2 * n * j);
          for (uint32_t c = 0; c < static_cast<uint32_t>(2 * n); ++c)
            if (runs[c].count > 0) found.push_back({page + c, runs[c]});
        }
      }
      slices.first = std::min(slices.first, slices.end);
      slices_.push_back(slices);
      // Into the pages, each by rising d; among equals the triangles' order stays.
      const auto skipped = static_cast<uint32_t>(2 * n * slices.first);
      const auto count = static_cast<size_t>(2 * n * (slices.end - slices.first));
      std::vector<uint32_t> begin(count + 1, 0);
      for (const PlacedRun& r : found) ++begin[r.page - skipped + 1];
      for (size_t page = 0; page < count; ++page) begin[page + 1] += begin[page];
      const auto base = static_cast<uint32_t>(runs_.size());
      for (size_t page = 1; page <= count; ++page) pages_.push_back(base + begin[page]);
      runs_.resize(runs_.size() + found.size());
      for (const PlacedRun& r : found) runs_[base + begin[r.page - skipped]++] = r.run;
      for (size_t page = 0, from = base; page < count; from = base + begin[page++])
        std::stable_sort(runs_.begin() + static_cast<std::ptrdiff_t>(from),
                         runs_.begin() + static_cast<std::ptrdiff_t>(base + begin[page]),
                         [](const LineRun& a, const LineRun& b) { return a.first < b.first; });
    }
  }
  for (const LineRun& run : runs_) hits_ += run.count;
}

std::span<const LineRun> LocalField::page(int family, int i, int j, int k) const {
  const Slices& s = slices(family, i);
  if (j < s.first || j >= s.end) return {};
  const uint32_t page = pageOf(s, j, k);
  return {runs_.data() + pages_[page], runs_.data() + pages_[page + 1]};
}

}  // namespace ninefold
