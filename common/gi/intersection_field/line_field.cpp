#include "common/gi/intersection_field/line_field.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "common/scene/alpha_test.h"
#include "common/scene/world.h"

namespace ninefold {
namespace {

const Mesh& meshOf(const Scene& scene, size_t instance) {
  return scene.meshes[static_cast<size_t>(scene.instances[instance].mesh)];
}

}  // namespace

LineField::LineField(const LineGrid& grid, const Scene& scene, const LineField* before)
    : scene_(scene), grid_(grid) {
  const Scene& its = scene_;
  for (size_t i = 0; i < its.instances.size(); ++i) {
    const Mesh& mesh = meshOf(its, i);
    const DMat4& toWorld = its.instances[i].toWorld;
    const bool isKept =
        before != nullptr && i < before->instances() && before->local(i).isOf(grid_, mesh, toWorld);
    locals_.push_back(isKept ? before->locals_[i]
                             : std::make_shared<const LocalField>(grid_, mesh, toWorld));
  }
  // The instances of each slice, in their order.
  const auto forEachSlice = [&](const auto& visit) {
    for (uint32_t instance = 0; instance < locals_.size(); ++instance)
      for (int family = 0; family < LineGrid::kFamilies; ++family)
        for (int i = 0; i < grid_.directions(); ++i) {
          const LocalField::Slices& s = locals_[instance]->slices(family, i);
          for (int j = s.first; j < s.end; ++j) visit(grid_.sliceOf(family, i, j), instance);
        }
  };
  firstOfSlice_.assign(grid_.slices() + 1, 0);
  forEachSlice([&](uint32_t slice, uint32_t) { ++firstOfSlice_[slice + 1]; });
  for (uint32_t s = 0; s < grid_.slices(); ++s) firstOfSlice_[s + 1] += firstOfSlice_[s];
  instances_.resize(firstOfSlice_.back());
  std::vector<uint32_t> next(firstOfSlice_.begin(), firstOfSlice_.end() - 1);
  forEachSlice([&](uint32_t slice, uint32_t instance) { instances_[next[slice]++] = instance; });
}

std::span<const uint32_t> LineField::instancesAt(const GridLine& line) const {
  const uint32_t slice = grid_.sliceOf(line.family, line.i, line.j);
  return {instances_.data() + firstOfSlice_[slice], instances_.data() + firstOfSlice_[slice + 1]};
}

void LineField::hitsOf(const GridLine& line, std::vector<LineHit>& hits) const {
  hits.clear();
  for (const uint32_t instance : instancesAt(line))
    for (const LineRun& run : locals_[instance]->page(line.family, line.i, line.j, line.k)) {
      if (run.first > line.m) break;
      const LineHit hit{instance, run.triangle, run.at(line.m)};
      if (run.has(line.m) && !isHole(line, hit)) hits.push_back(hit);
    }
  std::sort(hits.begin(), hits.end(), [](const LineHit& a, const LineHit& b) {
    return std::tie(a.t, a.instance, a.triangle) < std::tie(b.t, b.instance, b.triangle);
  });
}

std::optional<LineHit> LineField::next(const GridLine& line, float t, bool isForward) const {
  const float least = grid_.rounding() / grid_.lengthOf(line);
  const float sign = isForward ? 1.0f : -1.0f;
  float nearest = std::numeric_limits<float>::infinity();  // along the way
  LineHit found;
  for (const uint32_t instance : instancesAt(line))
    for (const LineRun& run : locals_[instance]->page(line.family, line.i, line.j, line.k)) {
      if (run.first > line.m) break;
      if (!run.has(line.m)) continue;
      const float along = sign * (run.at(line.m) - t);
      if (!(along > least && along < nearest)) continue;
      const LineHit hit{instance, run.triangle, run.at(line.m)};
      if (!isHole(line, hit)) nearest = along, found = hit;
    }
  if (!(nearest < std::numeric_limits<float>::infinity())) return std::nullopt;
  return found;
}

bool LineField::isHole(const GridLine& line, const LineHit& hit) const {
  const Mesh& mesh = meshOf(scene_, hit.instance);
  if (scene_.materials[static_cast<size_t>(mesh.material)].alphaMode != AlphaMode::mask)
    return false;
  const Vec2 at = placeOf(line, hit);
  return isOpenAt(scene_, mesh, hit.triangle, at.x, at.y);
}

Vec2 LineField::placeOf(const GridLine& line, const LineHit& hit) const {
  const Mesh& mesh = meshOf(scene_, hit.instance);
  const DMat4& toWorld = scene_.instances[hit.instance].toWorld;
  const Triangle& t = mesh.triangles[hit.triangle];
  return barycentricsOf(worldPoint(toWorld, mesh.positions[t.x]),
                        worldPoint(toWorld, mesh.positions[t.y]),
                        worldPoint(toWorld, mesh.positions[t.z]), grid_.pointAt(line, hit.t));
}

size_t LineField::bytes() const {
  size_t sum = sizeof(uint32_t) * (firstOfSlice_.size() + instances_.size());
  for (const auto& local : locals_) sum += local->bytes();
  return sum;
}

Vec2 barycentricsOf(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
  const Vec3 e = b - a, f = c - a, n = glm::cross(e, f);
  const float square = glm::dot(n, n);
  if (!(square > 0)) return Vec2(0);
  const float u = std::clamp(glm::dot(glm::cross(p - a, f), n) / square, 0.0f, 1.0f);
  const float v = std::clamp(glm::dot(glm::cross(e, p - a), n) / square, 0.0f, 1.0f);
  const float sum = u + v;
  return sum > 1 ? Vec2(u, v) / sum : Vec2(u, v);
}

}  // namespace ninefold
