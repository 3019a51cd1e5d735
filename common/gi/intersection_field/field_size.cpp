#include "common/gi/intersection_field/field_size.h"

#include <numeric>

#include "common/gi/intersection_field/lamp_pairs.h"
#include "common/gi/intersection_field/node_lines.h"
#include "common/gi/method/too_large.h"

namespace ninefold {
namespace {

constexpr int kEvery = 3;
constexpr int kFewestDirections = 3, kFewestDistances = 2;

// Of one instance's lines.
struct Size {
  double bytes = 0, hits = 0;
  Size& operator+=(const Size& other) { return bytes += other.bytes, hits += other.hits, *this; }
};

Size sizeOfSlope(const LineGrid& grid, int family, int i, const FamilyCorners& corners,
                 const Mesh& mesh) {
  std::array<LineRun, 2 * LineGrid::kMostDirections> runs;
  uint64_t count = 0, hits = 0;
  int first = grid.distances(), end = 0;
  for (const Triangle& t : mesh.triangles) {
    const SlicedTriangle triangle(grid, family, i, corners.of(t));
    for (int j = triangle.first(grid); j < triangle.end(grid); ++j) {
      first = std::min(first, j), end = std::max(end, j + 1);
      runsOf(grid, family, segmentOf(triangle, j), 0, runs);
      for (int k = 0; k < 2 * grid.directions(); ++k) {
        const uint16_t lines = runs[static_cast<size_t>(k)].count;
        count += lines > 0 ? 1 : 0, hits += lines;
      }
    }
  }
  const auto slices = static_cast<uint64_t>(std::max(end - first, 0));
  const uint64_t pages = slices * static_cast<uint64_t>(2 * grid.directions());
  return {static_cast<double>(sizeof(LineRun) * count + sizeof(uint32_t) * (pages + slices)),
          static_cast<double>(hits)};
}

Size sizeOf(const LineGrid& grid, const Mesh& mesh, const DMat4& toWorld) {
  Size size;
  int counted = 0;
  for (int family = 0; family < LineGrid::kFamilies; ++family) {
    const FamilyCorners corners(grid, family, mesh, toWorld);
    for (int i = (grid.directions() / 2) % kEvery; i < grid.directions(); i += kEvery, ++counted)
      size += sizeOfSlope(grid, family, i, corners, mesh);
  }
  const double all = double{LineGrid::kFamilies} * grid.directions() / counted;
  return {all * size.bytes, all * size.hits};
}

struct Lines {
  int directions, distances;
};

// How many have room, where those of the settings take so many bytes; 0: none have. Runs of large
// triangles go with N^2 M, of small ones with N^2 M^2; what nodes keep, with none.
Lines fittingLines(const FieldPlan& plan, const Settings& s, double bytes) {
  const double most = s.maxFieldMemory * 0x1p20;
  double shrink = std::cbrt(most / bytes);
  for (int directions = s.fieldDirections; directions > kFewestDirections; shrink *= 0.95) {
    directions = std::max(static_cast<int>(s.fieldDirections * shrink), kFewestDirections);
    int distances = std::max(static_cast<int>(s.fieldDistances * shrink), kFewestDistances);
    while (std::gcd(directions, distances) != 1) --distances;
    if (distances < kFewestDistances) directions = kFewestDirections, distances = kFewestDistances;
    if (fieldBytes(LineGrid(plan.box, directions, distances), plan) <= most)
      return {directions, distances};
  }
  return {0, 0};
}

}  // namespace

double fieldBytes(const LineGrid& grid, const FieldPlan& plan) {
  auto bytes = static_cast<double>(sizeof(uint32_t) * grid.slices());
  for (size_t i = 0; i < plan.scene.instances.size(); ++i) {
    const Instance& instance = plan.scene.instances[i];
    const Mesh& mesh = plan.scene.meshes[static_cast<size_t>(instance.mesh)];
    const bool isKnown = plan.before != nullptr && i < plan.before->instances();
    const LocalField* known = isKnown ? &plan.before->local(i) : nullptr;
    const Size size =
        known != nullptr && known->isOf(grid, mesh, instance.toWorld)
            ? Size{static_cast<double>(known->bytes()), static_cast<double>(known->hits())}
            : sizeOf(grid, mesh, instance.toWorld);
    const size_t nodes = plan.elements.block(i).nodes();
    const size_t ofNodes = NodeLines::bytesOf(static_cast<uint64_t>(size.hits), nodes);
    const size_t ofLamps = plan.lamps * nodes * LampPairs::kBytesPerNode;
    bytes += size.bytes + static_cast<double>(ofNodes + ofLamps);
  }
  return bytes;
}

void checkFieldSize(const LineGrid& grid, const FieldPlan& plan, const Settings& s) {
  const double most = s.maxFieldMemory * 0x1p20;
  if (fieldBytes(grid, plan) < most / 2) return;
  // All clients decide alike, whatever they know already.
  const FieldPlan fresh{plan.scene, plan.box, plan.elements, plan.lamps};
  const double bytes = fieldBytes(grid, fresh);
  if (bytes <= most) return;
  const std::string refusal = fmt::format(
      "the intersection field would take {:.0f} MiB, --max-field-memory is {}: raise it, or use ",
      std::ceil(bytes * 0x1p-20), s.maxFieldMemory);
  const auto [directions, distances] = fittingLines(fresh, s, bytes);
  if (directions == 0)
    throw TooLarge(refusal + "--element-size larger, or another method", std::nullopt);
  TooLarge::Smaller smaller{s, fmt::format("{} x {}", directions, distances)};
  smaller.settings.fieldDirections = directions, smaller.settings.fieldDistances = distances;
  throw TooLarge(
      refusal + fmt::format("--field-directions {} --field-distances {}", directions, distances),
      smaller);
}

}  // namespace ninefold
