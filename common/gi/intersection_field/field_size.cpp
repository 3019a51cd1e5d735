#include "common/gi/intersection_field/field_size.h"

#include <numeric>

#include "common/base/error.h"
#include "common/gi/intersection_field/local_field.h"

namespace ninefold {
namespace {

constexpr int kEvery = 3;

uint64_t bytesOfSlope(const LineGrid& grid, int family, int i, const FamilyCorners& corners,
                      const Mesh& mesh) {
  std::array<LineRun, 2 * LineGrid::kMostDirections> runs;
  uint64_t count = 0;
  int first = grid.distances(), end = 0;
  for (const Triangle& t : mesh.triangles) {
    const SlicedTriangle triangle(grid, family, i, corners.of(t));
    for (int j = triangle.first(grid); j < triangle.end(grid); ++j) {
      first = std::min(first, j), end = std::max(end, j + 1);
      runsOf(grid, family, segmentOf(triangle, j), 0, runs);
      for (int k = 0; k < 2 * grid.directions(); ++k)
        count += runs[static_cast<size_t>(k)].count > 0 ? 1 : 0;
    }
  }
  const auto pages = static_cast<uint64_t>(std::max(end - first, 0) * 2 * grid.directions());
  return sizeof(LineRun) * count + sizeof(uint32_t) * pages;
}

}  // namespace

double fieldBytes(const Scene& scene, int directions, int distances) {
  const LineGrid grid(scene.bounds, directions, distances);
  uint64_t bytes = 0, counted = 0;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
    for (int family = 0; family < LineGrid::kFamilies; ++family) {
      const FamilyCorners corners(grid, family, mesh, instance.toWorld);
      for (int i = (directions / 2) % kEvery; i < directions; i += kEvery)
        bytes += bytesOfSlope(grid, family, i, corners, mesh);
    }
  }
  for (int i = (directions / 2) % kEvery; i < directions; i += kEvery) ++counted;
  return static_cast<double>(bytes) * directions / static_cast<double>(counted);
}

void checkFieldSize(const Scene& scene, const Settings& s) {
  const double most = s.maxFieldMemory * 0x1p20;
  const double bytes = fieldBytes(scene, s.fieldDirections, s.fieldDistances);
  if (bytes <= most) return;
  // Runs of large triangles go with N^2 M, of small ones with N^2 M^2.
  int directions = s.fieldDirections, distances = s.fieldDistances;
  double shrink = std::cbrt(most / bytes);
  do {
    directions = std::max(static_cast<int>(s.fieldDirections * shrink), 3);
    distances = std::max(static_cast<int>(s.fieldDistances * shrink), 2);
    while (std::gcd(directions, distances) != 1) --distances;
    if (distances < 2) directions = 3, distances = 2;
    shrink *= 0.95;
  } while (directions > 3 && fieldBytes(scene, directions, distances) > most);
  fail(
      "the intersection field would take {:.0f} MiB, --max-field-memory is {}: raise it, or use "
      "--field-directions {} --field-distances {}",
      std::ceil(bytes * 0x1p-20), s.maxFieldMemory, directions, distances);
}

}  // namespace ninefold
