// animated_node.h: a node of the file that moves, by itself or because one above it does.
// Threads: plain data.
#pragma once

#include <optional>
#include <vector>

#include "common/math/vec.h"

namespace ninefold {

// Values of one property at times [s], strictly ascending; at least one.
struct AnimationTrack {
  enum class Kind : uint8_t { step, linear, cubic } kind = Kind::step;
  std::vector<float> times;
  std::vector<DVec4> values;  // one per time; cubic: in-tangent, value, out-tangent
};

// A rotation is a quaternion (x, y, z, w), of any length but 0.
struct AnimatedNode {
  int node = 0;                // as Instance::node
  int parent = -1;             // before it in the list; -1: what is above it stands still
  DMat4 above{1};              // world matrix of what is above it, if that stands still
  DMat4 asRead{1};             // its world matrix in the file, in file coordinates
  std::optional<DMat4> fixed;  // its local matrix, if only what is above it moves
  AnimationTrack translation, rotation, scale;  // if not fixed
  double largestScale = 1;                      // of any axis at any key, without its sign
  bool hasInstances = false;
  int firstLight = 0, lights = 0;  // a run of the scene's lights
  int camera = -1;                 // index into the scene's list; -1 = none
};

}  // namespace ninefold
