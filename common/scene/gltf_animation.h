// gltf_animation.h: one animation (clip) of a glTF file: which nodes it moves, and how. The other
// clips do nothing. Of two channels that move the same property of a node the first counts.
//
// Owner: refers to the model.   Threads: one owner.
// Errors: throws Error that names animation and channel.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/scene/animated_node.h"

namespace tinygltf {
class Model;
struct Animation;
struct AnimationChannel;
struct AnimationSampler;
}  // namespace tinygltf

namespace ninefold {

class GltfAnimations {
 public:
  // `clip`: the name of the animation; nullopt: the first. Throws Error for a name that the file
  // does not have.
  GltfAnimations(const tinygltf::Model& model, const std::optional<std::string>& clip);

  // As read, but invertible where the node has an axis without length (gltf_transform.h).
  DMat4 localMatrix(int node) const;

  // Takes a node that the scene reaches, parents first. Returns its place in the list of those that
  // move, or -1. `parent`: the place of the node above.
  int enter(int node, int parent, const DMat4& above, const DMat4& toWorld);
  // Whether nothing moves.
  bool empty() const { return tracks_.empty() && weights_.empty(); }
  // Whether the weights of a node's morph targets change.
  bool morphs(int node) const { return weights_.contains(node); }
  // How, target by target. Throws Error unless they are of `targets`.
  const std::vector<AnimationTrack>& weightsOf(int node, size_t targets) const;
  AnimatedNode& operator[](int place) { return nodes_[static_cast<size_t>(place)]; }
  std::vector<AnimatedNode> take() { return std::move(nodes_); }

 private:
  struct Tracks {
    AnimationTrack translation, rotation, scale;
  };
  double largestScale(int node) const;
  void read(const tinygltf::Animation& animation, const tinygltf::AnimationChannel& channel);
  void readWeights(const tinygltf::AnimationSampler& sampler, int node);

  const tinygltf::Model* model_;
  std::map<int, Tracks> tracks_;                        // by node; empty ones are not animated
  size_t keys_ = 0;                                     // of all tracks
  std::map<int, std::vector<AnimationTrack>> weights_;  // by node and morph target
  std::vector<AnimatedNode> nodes_;
};

}  // namespace ninefold
