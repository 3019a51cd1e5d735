#include "common/gi/elements/node_parts.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "common/math/rounding.h"
#include "common/scene/alpha_test.h"

namespace ninefold {
namespace {

// Pieces along the side of an element: to see whether all are alike, and to measure them if not.
constexpr uint32_t kFewRows = 4, kRows = 10;
constexpr double kLeast = 1 / 128.0;

using Sides = std::array<uint8_t, 3>;
using Weights = std::array<float, 3>;
constexpr Sides kCovered = {255, 255, 255};

float longestOf(const Tracer::Corners& t) {
  return std::max({glm::length(t.b - t.a), glm::length(t.c - t.b), glm::length(t.a - t.c)});
}

// Of the first that is not covered.
Sides openSideOf(const std::vector<Sides>& all) {
  const auto open = std::ranges::find_if(all, [](const Sides& s) { return s != kCovered; });
  return open == all.end() ? Sides{} : *open;
}

// One face of an element, and what stands on it.
struct Face {
  SurfaceSight sight;
  std::array<Vec3, 3> nodes;  // where they are
  Vec3 normal;

  Sides raysFrom(Vec3 x) const {
    Sides sides{};
    for (size_t c = 0; c < 3; ++c) sides[c] = sight.hides(x, normal, nodes[c]);
    return sides;
  }
  // `seen`: raysFrom each corner.
  Sides sidesAt(Vec3 x, const std::array<Sides, 3>& seen) const {
    const Sides rays = raysFrom(x);
    Sides sides = rays;
    for (size_t c = 0; c < 3; ++c)
      for (size_t by = 0; by < 3; ++by)
        if (rays[by] == 0 && seen[by][c] == 0) sides[c] = 0;
    return sides;
  }
};

Face faceOf(const Tracer& tracer, uint32_t instance, const ElementBlock& block, uint32_t triangle,
            const std::array<uint32_t, 3>& nodes, bool isBack) {
  const Vec3 origin = Vec3(tracer.scene().instances[instance].toWorld[3]);
  const Vec3 front = tracer.frontNormal(instance, triangle);
  Face face{{tracer, block.size()}, {}, isBack ? -front : front};
  for (size_t c = 0; c < 3; ++c) face.nodes[c] = origin + block.position(nodes[c]);
  return face;
}

}  // namespace

// Of one block.
class NodeParts::Making {
 public:
  Making(NodeParts& parts, const Tracer& tracer, uint32_t instance, const ElementBlock& block,
         const NodeParts* before, std::span<const Bounds> changed)
      : parts_(parts),
        before_(before),
        changes_{before == nullptr, changed},
        tracer_(tracer),
        scene_(tracer.scene()),
        mesh_(scene_.meshes[static_cast<size_t>(scene_.instances[instance].mesh)]),
        hasHoles_(scene_.materials[static_cast<size_t>(mesh_.material)].alphaMode ==
                  AlphaMode::mask),
        instance_(instance),
        block_(block),
        free_(2 * block.nodes(), 0) {}

  // Which elements are divided, and how.
  void look() {
    for (uint32_t k = 0; k < block_.triangles(); ++k) {
      if (block_.cuts(k) == 0 || isFine(k)) continue;
      const bool isNear = changes_.areNear(tracer_, instance_, block_, k);
      std::vector<bool> standing;
      if (isNear) standing = standingOn(tracer_, instance_, block_, k, changes_);
      size_t face = 0;
      block_.forEachElement(k, [&](const Element& e) {
        const bool isNew = isNear && changes_.areNear(tracer_, instance_, block_, e);
        for (const bool isBack : {false, true}) {
          if (isNew && standing[face]) look(e, isBack);
          if (!isNew) keepFrom(*before_, 2 * e.number + isBack);
          ++face;
        }
      });
    }
  }

  // The areas of all parts, and which they are.
  void measure() {
    block_.forEachElement([&](const Element& e) {
      for (const bool isBack : {false, true})
        forEachPiece(e, isBack, [&](const Weights& weights, const Sides& sides, double area) {
          for (size_t c = 0; c < 3; ++c) {
            const uint32_t face = 2 * e.nodes[c] + isBack;
            (sides[c] == 0 ? free_[face] : hidden_[16 * face + sides[c]]) +=
                double{weights[c]} * area;
          }
        });
    });
    parts_.areas_.assign(free_.begin(), free_.end());
    for (auto first = hidden_.cbegin(); first != hidden_.cend();) first = take(first);
  }

  // The places that need a look.
  void keep() {
    block_.forEachElement([&](const Element& e) {
      for (const bool isBack : {false, true}) {
        Found found;
        const auto divided = parts_.divided_.find(2 * e.number + isBack);
        Sides sides{};
        if (divided != parts_.divided_.end()) {
          found.seen = divided->second.seen;
          found.isWhole = divided->second.isWhole;
          if (found.isWhole) sides = openSideOf(divided->second.sides);
        }
        bool isPlain = found.isWhole;
        for (size_t c = 0; c < 3; ++c) {
          const uint32_t face = 2 * e.nodes[c] + isBack;
          found.parts[c] = parts_.partOf(face, sides[c]);
          isPlain = isPlain && found.parts[c] == face;
        }
        if (!isPlain) parts_.found_.emplace(2 * e.number + isBack, found);
      }
    });
  }

 private:
  using Areas = std::map<uint32_t, double>;  // by 16 (face of a node) + side

  Vec3 placeOf(const Element& e, const Weights& weights) const {
    const Tracer::Corners at = tracer_.corners(instance_, e.triangle);
    const Vec2 uv = e.at(weights);
    return pointOnTriangle(at.a, at.b, at.c, uv.x, uv.y);
  }
  // Its nodes are of many triangles.
  bool isFine(uint32_t triangle) const {
    return block_.cuts(triangle) == 1 &&
           longestOf(tracer_.corners(instance_, triangle)) < 0.5f * block_.size();
  }
  void keepFrom(const NodeParts& before, uint32_t face) {
    const auto found = before.divided_.find(face);
    if (found != before.divided_.end()) parts_.divided_.insert(*found);
  }

  void look(const Element& e, bool isBack) {
    const Face face = faceOf(tracer_, instance_, block_, e.triangle, e.nodes, isBack);
    if (face.normal == Vec3(0)) return;
    Divided divided;
    std::array<Weights, 3> corners;
    for (size_t c = 0; c < 3; ++c) {
      // A corner may lie in what stands there, so that one looks from beside it.
      corners[c] = {0.009f, 0.007f, 0.004f};
      corners[c][c] += 0.98f;
      divided.seen[c] = face.raysFrom(placeOf(e, corners[c]));
    }
    const auto sidesAt = [&](const Weights& weights) {
      return face.sight.isCovered(instance_, e.triangle, e.at(weights), isBack)
                 ? kCovered
                 : face.sidesAt(placeOf(e, weights), divided.seen);
    };
    std::vector<Sides> ends;
    for (const Weights& corner : corners) ends.push_back(sidesAt(corner));
    for (const uint32_t most : {kFewRows, kRows}) {
      divided.sides.clear();
      forEachMiddle(piecesAlong(e, block_.size(), most),
                    [&](const Weights& w) { divided.sides.push_back(sidesAt(w)); });
      const Sides open = openSideOf(divided.sides);
      const auto isLike = [&](const Sides& s) { return s == open || s == kCovered; };
      divided.isWhole =
          std::ranges::all_of(divided.sides, isLike) && std::ranges::all_of(ends, isLike);
      const auto covered = std::ranges::count(divided.sides, kCovered);
      if (divided.isWhole && (covered == 0 || covered == std::ssize(divided.sides))) {
        divided.sides.resize(1);
        break;
      }
    }
    if (!divided.isWhole || divided.sides != std::vector<Sides>{Sides{}})
      parts_.divided_.emplace(2 * e.number + isBack, std::move(divided));
  }

  // visit(weights, sides, area) for the pieces of an element's face that light can reach.
  template <typename Visit>
  void forEachPiece(const Element& e, bool isBack, const Visit& visit) const {
    const auto found = parts_.divided_.find(2 * e.number + isBack);
    const std::vector<Sides>* sides =
        found == parts_.divided_.end() ? nullptr : &found->second.sides;
    const uint32_t rows = sides != nullptr
                              ? static_cast<uint32_t>(std::lround(std::sqrt(sides->size())))
                          : hasHoles_ ? kFewRows
                                      : 1;
    const double area = double{e.area} / (rows * rows);
    size_t k = 0;
    forEachMiddle(rows, [&](const Weights& weights) {
      const Sides its = sides == nullptr ? Sides{} : (*sides)[k++];
      const Vec2 uv = e.at(weights);
      if (its == kCovered || (hasHoles_ && isOpenAt(scene_, mesh_, e.triangle, uv.x, uv.y))) return;
      visit(weights, its, area);
    });
  }

  // The parts of one face of a node that have hidden ones. Returns where the next face's begin.
  Areas::const_iterator take(Areas::const_iterator first) {
    const uint32_t face = first->first / 16;
    const Areas::const_iterator end = hidden_.lower_bound(16 * (face + 1));
    std::vector<std::pair<double, uint32_t>> all{{free_[face], 16 * face}};
    for (auto part = first; part != end; ++part) all.emplace_back(part->second, part->first);
    const auto largest = std::ranges::max_element(all);
    std::swap(*largest, all.front());
    const double least = kLeast * double{block_.size()} * double{block_.size()};
    double sum = all.front().first;  // and what goes with it
    for (const auto& [area, key] : std::span(all).subspan(1)) {
      if (area < least) {
        sum += area;
        continue;
      }
      parts_.others_.emplace(key, static_cast<uint32_t>(parts_.areas_.size()));
      parts_.areas_.push_back(static_cast<float>(area));
    }
    parts_.areas_[face] = static_cast<float>(sum);
    return end;
  }

  NodeParts& parts_;
  const NodeParts* before_;
  const SceneChanges changes_;
  const Tracer& tracer_;
  const Scene& scene_;
  const Mesh& mesh_;
  const bool hasHoles_;
  const uint32_t instance_;
  const ElementBlock& block_;
  std::vector<double> free_;  // area of side 0, by face of a node
  Areas hidden_;
};

NodeParts::NodeParts(const Tracer& tracer, uint32_t instance, const ElementBlock& block,
                     const NodeParts* before, std::span<const Bounds> changed) {
  Making making(*this, tracer, instance, block, before, changed);
  making.look();
  making.measure();
  making.keep();
}

NodeParts::NodeParts(const Tracer& tracer, uint32_t instance, const ElementBlock& block) {
  Making(*this, tracer, instance, block, nullptr, {}).measure();
}

uint32_t NodeParts::partOf(uint32_t face, uint8_t side) const {
  const auto found = others_.find(16 * face + side);
  return found == others_.end() ? face : found->second;
}

PartPlace NodeParts::at(const Tracer& tracer, const ElementBlock& block,
                        const SurfaceNumbers::Surface& surface, float u, float v) const {
  const ElementPlace there = block.at(surface.triangle, u, v);
  const bool isBack = surface.isBack != there.isTurned;
  PartPlace place{{}, there.weights};
  for (size_t c = 0; c < 3; ++c) place.parts[c] = 2 * there.nodes[c] + isBack;
  const auto found = found_.find(2 * there.element + isBack);
  if (found == found_.end()) return place;
  if (found->second.isWhole) {
    place.parts = found->second.parts;
    return place;
  }
  const Face face = faceOf(tracer, surface.instance, block, there.triangle, there.nodes, isBack);
  const Tracer::Corners at = tracer.corners(surface.instance, surface.triangle);
  const Sides sides = face.sidesAt(pointOnTriangle(at.a, at.b, at.c, u, v), found->second.seen);
  for (size_t c = 0; c < 3; ++c) place.parts[c] = partOf(place.parts[c], sides[c]);
  return place;
}

}  // namespace ninefold
