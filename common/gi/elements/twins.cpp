#include "common/gi/elements/twins.h"

#include <bit>
#include <optional>
#include <vector>

#include "common/sampling/hash.h"

namespace ninefold {
namespace {

uint64_t hashOf(Vec3 p) {
  const auto bits = [](float x) { return uint64_t{std::bit_cast<uint32_t>(x == 0 ? 0.0f : x)}; };
  return hashWords(bits(p.x), bits(p.y), bits(p.z));
}

// The corners of `b` as those of `a`, if they are the same points.
std::optional<Twins::Twin> twinOf(const Mesh& mesh, uint32_t a, uint32_t b) {
  constexpr uint8_t kWays[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1},
                                   {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  const Triangle &first = mesh.triangles[a], &later = mesh.triangles[b];
  for (int way = 0; way < 6; ++way) {
    const auto& c = kWays[way];
    if (mesh.positions[later.x] == mesh.positions[first[c[0]]] &&
        mesh.positions[later.y] == mesh.positions[first[c[1]]] &&
        mesh.positions[later.z] == mesh.positions[first[c[2]]])
      return Twins::Twin{a, {c[0], c[1], c[2]}, way >= 3};
  }
  return std::nullopt;
}

}  // namespace

Twins::Twins(const Mesh& mesh) {
  std::unordered_map<uint64_t, std::vector<uint32_t>> known;  // by the sum of the corners' hashes
  for (uint32_t k = 0; k < mesh.triangles.size(); ++k) {
    const Triangle& t = mesh.triangles[k];
    std::vector<uint32_t>& alike = known[hashOf(mesh.positions[t.x]) + hashOf(mesh.positions[t.y]) +
                                         hashOf(mesh.positions[t.z])];
    bool isLater = false;
    for (const uint32_t earlier : alike)
      if (const auto twin = twinOf(mesh, earlier, k); twin && !isLater)
        twins_[k] = *twin, isLater = true;
    if (!isLater) alike.push_back(k);
  }
}

}  // namespace ninefold
