// node_lines.h: the lines through each node of an instance's mesh elements.
//
// A hit of a line stands for its element's three corners (element_block.h). It is given to one of
// them, chosen with its weight by a hash of the hit, so that a node's lines have the measure
//
//   sum of mu ~ pi A       A: area of the node [m^2], mu: line_grid.h
//
// A line chosen in proportion to mu then leaves the node in a cosine-distributed direction from an
// evenly distributed place, as light does that a matte surface sends. (As published the line
// nearest to a chosen place and direction is taken, whether or not it passes there; near edges
// light then goes astray.)
//
// kEach lines a node are enough. Where there are more, only every s-th of a run is kept; it stands
// for all of them.
//
// Memory:  12 bytes a line that is kept, 16 a node.   Source: made for this project.
// Proved:  tests/gi/node_lines_test.cpp.
// Threads: const after construction.   Errors: none.
#pragma once

#include <optional>
#include <vector>

#include "common/gi/elements/element_block.h"
#include "common/gi/intersection_field/line_field.h"

namespace ninefold {

class NodeLines {
 public:
  static constexpr size_t kEach = 512;

  NodeLines(const LineField& field, const Scene& scene, uint32_t instance,
            const ElementBlock& block);

  struct Start {
    GridLine line;
    LineHit hit;
  };
  // In proportion to mu; nothing: no line passes the node. u in [0, 1).
  std::optional<Start> choose(const LineField& field, uint32_t node, float u) const;
  // Sum of mu over the lines of a node, each by the node's weight at its hit [m^2 sr].
  double measureOf(uint32_t node) const { return measures_[node]; }
  // pi A / measure: how much more its lines would stand for if they lay evenly; within [1/4, 4], 1
  // for a node without lines.
  float gain(uint32_t node) const { return gains_[node]; }
  size_t bytes() const {
    return (sizeof(Entry) + sizeof(float)) * entries_.size() +
           (sizeof(uint32_t) + sizeof(double) + sizeof(float)) * gains_.size();
  }
  // About, of an instance with so many nodes that lines hit so often.
  static size_t bytesOf(uint64_t hits, size_t nodes);

 private:
  struct Entry {
    uint32_t line, run;
  };
  uint32_t instance_;
  std::vector<uint32_t> first_;  // by node, into the next two; and the end
  std::vector<Entry> entries_;
  std::vector<double> measures_;
  std::vector<float> gains_;
  std::vector<float> cumulative_;  // mu of a node's lines up to this one
};

}  // namespace ninefold
