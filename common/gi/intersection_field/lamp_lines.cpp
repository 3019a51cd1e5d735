#include "common/gi/intersection_field/lamp_lines.h"

#include <algorithm>
#include <tuple>

#include "common/gi/light/straight_light.h"
#include "common/scene/alpha_test.h"
#include "common/scene/world.h"

namespace ninefold {
namespace {

// What hides a lamp nearer to a surface than this share of an element's side covers the surface.
constexpr float kClose = 0.125f;

const Mesh& meshOf(const Scene& scene, uint32_t instance) {
  return scene.meshes[static_cast<size_t>(scene.instances[instance].mesh)];
}

}  // namespace

LampScene::LampScene(const Transport& transport, const LineField& lines,
                     const SceneElements& places)
    : t(transport), field(lines), elements(places) {
  const LineGrid& grid = field.grid();
  std::vector<double> measures;
  double sum = 0;
  for (int family = 0; family < LineGrid::kFamilies; ++family)
    for (int i = 0; i < grid.directions(); ++i)
      for (int k = 0; k < 2 * grid.directions(); ++k) {
        const GridLine line{family, i, 0, k, 0};
        ways.push_back({grid.directionOf(line), grid.lengthOf(line), 1});
        measures.push_back(grid.measureOf(line));
        sum += measures.back();
      }
  if (t.settings.fieldWeights != FieldWeights::measure) return;
  const double mean = sum / static_cast<double>(measures.size());
  for (size_t i = 0; i < ways.size(); ++i) ways[i].weight = static_cast<float>(measures[i] / mean);
}

LampLines::LampLines(const LampScene& scene)
    : scene_(scene),
      grid_(scene.field.grid()),
      vertices_(scene.field.instances()),
      chordOf_(scene.field.instances()) {}

const std::vector<LampLines::Pair>& LampLines::pairsOf(const AreaLamp& lamp, const GridLine& page,
                                                       const Lines* wanted) {
  pairs_.clear();
  enter(page);
  const auto runsAt = [&](uint32_t instance) {
    return scene_.field.local(instance).page(page.family, page.i, page.j, page.k);
  };
  int first = grid_.distances(), end = 0;  // lines of the lamp
  for (const LineRun& run : runsAt(lamp.instance))
    first = std::min(first, int{run.first}), end = std::max(end, run.first + run.count);
  for (const uint32_t instance : scene_.field.instancesAt(page))
    for (const LineRun& run : runsAt(instance)) {
      if (run.first >= end) break;
      if (run.first + run.count > first)
        crossings_.push_back(crossingOf(chordOf(instance, run.triangle), run));
    }
  for (const Crossing& q : crossings_)
    if (chords_[q.chord].instance == lamp.instance) addRun(lamp, q, wanted);
  return pairs_;
}

void LampLines::enter(const GridLine& page) {
  const bool isSameSlice = page.family == page_.family && page.i == page_.i && page.j == page_.j;
  if (!isSameSlice) chords_.clear();
  page_ = page;
  way_ = &scene_.wayOf(page);
  crossings_.clear();
}

uint32_t LampLines::chordOf(uint32_t instance, uint32_t triangle) {
  std::vector<uint32_t>& known = chordOf_[instance];
  if (known.empty()) known.resize(meshOf(scene_.t.scene, instance).triangles.size());
  uint32_t& at = known[triangle];
  const bool isKnown =
      at < chords_.size() && chords_[at].instance == instance && chords_[at].triangle == triangle;
  if (!isKnown) {
    at = static_cast<uint32_t>(chords_.size());
    chords_.push_back(chordAt(instance, triangle));
  }
  return at;
}

LampLines::Chord LampLines::chordAt(uint32_t instance, uint32_t triangle) {
  const Scene& scene = scene_.t.scene;
  const Mesh& mesh = meshOf(scene, instance);
  std::vector<Vec3>& vertices = vertices_[instance];
  if (vertices.empty())
    for (const Vec3& p : mesh.positions)
      vertices.push_back(worldPoint(scene.instances[instance].toWorld, p));
  const Triangle& t = mesh.triangles[triangle];
  const Vec3 a = vertices[t.x], b = vertices[t.y], c = vertices[t.z];
  const auto turned = [&](const Vec3& p) { return grid_.toFamily(page_.family, p); };
  const Segment segment = segmentOf(
      SlicedTriangle(grid_, page_.family, page_.i, {turned(a), turned(b), turned(c)}), page_.j);
  const auto placeAt = [&](Vec2 uw) {
    return barycentricsOf(a, b, c, grid_.pointIn(page_, uw.x, uw.y));
  };

  Chord chord{instance, triangle, false, false, false, {}, {}, {}, {}, 0, 0};
  const Material& material = scene.materials[static_cast<size_t>(mesh.material)];
  chord.hasHoles = material.alphaMode == AlphaMode::mask;
  chord.passesLight = scene_.t.shader.mayPassStraight(mesh.material);
  chord.elements = scene_.elements.block(instance).elementsOf(triangle);
  chord.normal = scene_.t.tracer.frontNormal(instance, triangle);
  const Vec2 way = segment.q - segment.p;
  chord.isAlongU = std::abs(way.x) >= std::abs(way.y);
  const float length = chord.isAlongU ? way.x : way.y;
  chord.first = chord.isAlongU ? segment.p.x : segment.p.y;
  chord.scale = length != 0 ? 1 / length : 0;
  chord.from = placeAt(segment.p);
  chord.across = placeAt(segment.q) - chord.from;
  return chord;
}

LampLines::Crossing LampLines::crossingOf(uint32_t number, const LineRun& run) const {
  const Chord& chord = chords_[number];
  Crossing crossing{run, number, 0, 0, glm::dot(chord.normal, way_->forward)};
  float first = run.t, step = run.step;  // u or w, whichever the chord goes by
  if (chord.isAlongU == grid_.isSteep(page_.k)) {
    const LineGrid::Places& d = grid_.placesOfD(page_.family, page_.k);
    const float c = grid_.slope(page_.k);
    first = c * run.t + (static_cast<float>(run.first) - d.offset) / d.scale;
    step = c * run.step + 1 / d.scale;
  }
  crossing.share = (first - chord.first) * chord.scale, crossing.step = step * chord.scale;
  return crossing;
}

Vec2 LampLines::placeOf(const Crossing& crossing, int m) const {
  const Chord& chord = chords_[crossing.chord];
  const float share = crossing.share + static_cast<float>(m - crossing.run.first) * crossing.step;
  return chord.from + std::clamp(share, 0.0f, 1.0f) * chord.across;
}

bool LampLines::isHole(const Crossing& crossing, int m) const {
  const Chord& chord = chords_[crossing.chord];
  if (!chord.hasHoles) return false;
  const Scene& scene = scene_.t.scene;
  const Vec2 at = placeOf(crossing, m);
  return isOpenAt(scene, meshOf(scene, chord.instance), chord.triangle, at.x, at.y);
}

// L/L_max at q.
float LampLines::brightnessAt(const AreaLamp& lamp, const Crossing& q, int m) const {
  const Emitters& emitters = scene_.t.emitters;
  const int emitter = emitters.find(lamp.instance, q.run.triangle);
  return maxComponent(emitters.pointAt(static_cast<uint32_t>(emitter), placeOf(q, m)).radiance) /
         lamp.brightest;
}

void LampLines::addRun(const AreaLamp& lamp, const Crossing& q, const Lines* wanted) {
  if (scene_.t.emitters.find(lamp.instance, q.run.triangle) < 0) return;  // a dark part of it
  const bool isUneven = !lamp.isEven && scene_.t.settings.fieldWeights == FieldWeights::measure;
  for (int m = q.run.first; m < q.run.first + q.run.count; ++m) {
    if (wanted != nullptr && !(*wanted)[static_cast<size_t>(m)]) continue;
    if (isHole(q, m)) continue;
    const float weight = isUneven ? way_->weight * brightnessAt(lamp, q, m) : way_->weight;
    for (const bool isForward : {false, true})
      if (lamp.doubleSided || (q.cosine > 0) == isForward) addLine(q, m, isForward, weight);
  }
}

// Beyond q, the nearest first; what lies in one place, in the order of instances and triangles.
void LampLines::findHits(const Crossing& q, int m, bool isForward) {
  const float sign = isForward ? 1.0f : -1.0f;
  const float least = sign * q.run.at(m) + grid_.rounding() / way_->length;
  const auto isNearer = [&](const Near& a, const Near& b) {
    if (a.t != b.t) return a.t < b.t;
    const Chord &x = chords_[a.crossing->chord], &y = chords_[b.crossing->chord];
    return std::tie(x.instance, x.triangle) < std::tie(y.instance, y.triangle);
  };
  near_.clear();
  for (const Crossing& crossing : crossings_) {
    if (!crossing.run.has(m)) continue;
    const Near hit{sign * crossing.run.at(m), &crossing};
    if (hit.t < least || isHole(crossing, m)) continue;
    near_.push_back(hit);
    for (size_t k = near_.size() - 1; k > 0 && isNearer(hit, near_[k - 1]); --k)
      std::swap(near_[k - 1], near_[k]);
  }
}

void LampLines::addLine(const Crossing& q, int m, bool isForward, float weight) {
  findHits(q, m, isForward);
  const float close = kClose * scene_.t.settings.elementSize * scene_.t.radius / way_->length;
  Vec3 seen(1);
  float last = 0;  // t of the hit before
  for (const Near& hit : near_) {
    const Chord& chord = chords_[hit.crossing->chord];
    const bool isBack = isForward ? hit.crossing->cosine > 0 : hit.crossing->cosine < 0;
    const bool isCovered = isBlack(seen) && hit.t - last < close;
    if (!isCovered)
      pairs_.push_back(
          {chord.instance, isBack, chord.elements, placeOf(*hit.crossing, m), weight, seen});
    if (!isBlack(seen)) seen *= passed(*hit.crossing, m, isForward);
    last = hit.t;
  }
}

// Share of light on its way that a surface lets pass straight on.
Vec3 LampLines::passed(const Crossing& crossing, int m, bool isForward) const {
  const Chord& chord = chords_[crossing.chord];
  if (!chord.passesLight) return Vec3(0);
  const Transport& t = scene_.t;
  const Vec2 at = placeOf(crossing, m);
  const SurfacePoint surface = t.tracer.surface(Hit{chord.instance, chord.triangle, at.x, at.y, 0});
  if (!t.shader.passesStraight(surface)) return Vec3(0);
  const Vec3 way = isForward ? way_->forward : -way_->forward;
  return straightPass(t.shader.shade(surface, -way, MediumStack()));
}

}  // namespace ninefold
