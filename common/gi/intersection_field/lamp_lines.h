// lamp_lines.h: the pairs (p, q) that the lines of a page make with a lamp: lamp_pairs.h says which
// they are.
//
//   slice   meets a triangle in a chord. Barycentrics go evenly along it: its two ends tell them.
//   page    Its runs that have lines of the lamp are written down once. On a run the place on the
//           chord goes evenly from line to line.
//   line    its hits on the side of q that shines, the nearest first
//
// So a hit costs no more than a few products, where LineField::hitsOf and placeOf ask the page and
// the mesh for each of them anew.
//
// Source:  Ren et al. 2005, 5 (VRM).   Proved: tests/gi/lamp_lines_test.cpp.
// Threads: one owner.   Owner: refers to the scene.   Errors: none.
#pragma once

#include <bitset>
#include <vector>

#include "common/gi/elements/scene_elements.h"
#include "common/gi/intersection_field/area_lamps.h"
#include "common/gi/intersection_field/line_field.h"

namespace ninefold {

// What pairs are made of.
struct LampScene {
  // What all lines of one (family, a, c) have in common.
  struct Way {
    Vec3 forward;  // unit, t grows
    float length;  // |D|
    float weight;  // mu over its mean
  };

  LampScene(const Transport& transport, const LineField& lines, const SceneElements& places);
  const Way& wayOf(const GridLine& line) const {
    const int n = field.grid().directions();
    return ways[static_cast<size_t>((line.family * n + line.i) * 2 * n + line.k)];
  }

  const Transport& t;
  const LineField& field;
  const SceneElements& elements;
  std::vector<Way> ways;
};

class LampLines {
 public:
  using Lines = std::bitset<LineGrid::kMostDistances + 1>;  // of a page, by m

  struct Pair {
    uint32_t instance;
    bool isBack;                // of p's triangle, where the light comes to
    TriangleElements elements;  // of p's triangle
    Vec2 at;                    // of p, barycentrics
    float weight;               // g
    Vec3 seen;                  // vis
  };

  explicit LampLines(const LampScene& scene);
  const LampScene& scene() const { return scene_; }
  // The pairs of a page. `wanted`: on these lines alone; null: on all. Good until the next call.
  const std::vector<Pair>& pairsOf(const AreaLamp& lamp, const GridLine& page, const Lines* wanted);

 private:
  // Where the present slice meets a triangle.
  struct Chord {
    uint32_t instance, triangle;
    bool hasHoles, passesLight, isAlongU;
    TriangleElements elements;
    Vec3 normal;         // of the triangle's front
    Vec2 from, across;   // barycentrics of one end, and to the other
    float first, scale;  // (u or w - first) scale is the share of the way across
  };
  // A run of the present page.
  struct Crossing {
    LineRun run;
    uint32_t chord;
    float share, step;  // of the way across, at the run's first line and from line to line
    float cosine;       // of the triangle's front and the way forward
  };
  struct Near {
    float t;  // away from q it grows
    const Crossing* crossing;
  };

  void enter(const GridLine& page);
  uint32_t chordOf(uint32_t instance, uint32_t triangle);
  Chord chordAt(uint32_t instance, uint32_t triangle);
  Crossing crossingOf(uint32_t chord, const LineRun& run) const;
  Vec2 placeOf(const Crossing& crossing, int m) const;
  bool isHole(const Crossing& crossing, int m) const;
  float brightnessAt(const AreaLamp& lamp, const Crossing& q, int m) const;
  void addRun(const AreaLamp& lamp, const Crossing& q, const Lines* wanted);
  void findHits(const Crossing& q, int m, bool isForward);
  void addLine(const Crossing& q, int m, bool isForward, float weight);
  Vec3 passed(const Crossing& crossing, int m, bool isForward) const;

  const LampScene& scene_;
  const LineGrid& grid_;
  std::vector<std::vector<Vec3>> vertices_;     // by instance, in the scene; empty: not yet asked
  std::vector<std::vector<uint32_t>> chordOf_;  // by instance and triangle; may be out of date
  std::vector<Chord> chords_;                   // of the present slice
  GridLine page_{-1, 0, 0, 0, 0};               // the present one
  const LampScene::Way* way_ = nullptr;         // of its lines
  std::vector<Crossing> crossings_;             // likewise
  std::vector<Near> near_;                      // of one line
  std::vector<Pair> pairs_;
};

}  // namespace ninefold
