// gltf_animation.h: the animations of a glTF file: which nodes they move, and how. All animations of the
// file play at once; where two move the same property of a node, the first one does.
//
// Morph weights are left out with a warning. Refers to the model.
// Errors: throws Error that names animation and channel. Threads: one owner.
#pragma once

#include <map>
#include <vector>

#include "common/scene/animated_node.h"

namespace tinygltf {
class Model;
struct Animation;
struct AnimationChannel;
}  // namespace tinygltf

namespace ninefold {

class GltfAnimations {
 public:
  explicit GltfAnimations(const tinygltf::Model& model);

  // A node that the scene reaches, parents first. Its place in the list of those that move, or -1;
  // `parent`: that of the node above.
  int enter(int node, int parent, const DMat4& above, const DMat4& toWorld);
  AnimatedNode& operator[](int place) { return nodes_[static_cast<size_t>(place)]; }
  std::vector<AnimatedNode> take() { return std::move(nodes_); }

 private:
  struct Tracks {
    AnimationTrack translation, rotation, scale;
  };
  void read(const tinygltf::Animation& animation, const tinygltf::AnimationChannel& channel);

  const tinygltf::Model* model_;
  std::map<int, Tracks> tracks_;  // by node; empty ones are not animated
  size_t keys_ = 0;               // of all tracks
  bool morphs_ = false;
  std::vector<AnimatedNode> nodes_;
};

}  // namespace ninefold
