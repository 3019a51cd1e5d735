#include "common/scene/gltf_animation.h"

#include <tiny_gltf.h>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/scene/gltf_accessor.h"
#include "common/scene/gltf_transform.h"

namespace ninefold {
namespace {

using Kind = AnimationTrack::Kind;

constexpr size_t kMaxKeys = 4'000'000;  // of a file

Kind kindNamed(const std::string& name) {
  if (name == "STEP") return Kind::step;
  if (name == "LINEAR") return Kind::linear;
  if (name == "CUBICSPLINE") return Kind::cubic;
  fail("the interpolation '{}' is unknown", name);
}

size_t valuesOfAKey(Kind kind) { return kind == Kind::cubic ? 3 : 1; }

// At most `most` keys. Times must ascend, so a file's claim costs no more than what it holds.
AnimationTrack readTimes(const tinygltf::Model& model, const tinygltf::AnimationSampler& sampler,
                         size_t most) {
  AnimationTrack track;
  track.kind = kindNamed(sampler.interpolation);
  const GltfAccessor times(model, sampler.input, 1, "input");
  if (times.count() == 0) fail("it has no times");
  if (times.count() > most) fail("more than {} keys in the file: export fewer", kMaxKeys);
  for (size_t i = 0; i < times.count(); ++i) {
    const float time = times.element(i).x;
    const float least = track.times.empty() ? 0.0f : track.times.back();
    const bool ascends = track.times.empty() ? time >= least : time > least;
    if (!ascends || !std::isfinite(time)) fail("time {} is {} after {}", i, time, least);
    track.times.push_back(time);
  }
  return track;
}

AnimationTrack readTrack(const tinygltf::Model& model, const tinygltf::AnimationSampler& sampler,
                         int components, size_t most) {
  AnimationTrack track = readTimes(model, sampler, most);
  const GltfAccessor values(model, sampler.output, components, "output");
  const size_t each = valuesOfAKey(track.kind), keys = track.times.size();
  if (values.count() != each * keys)
    fail("{} times and {} values do not go together", keys, values.count());
  for (size_t i = 0; i < keys; ++i) {
    for (size_t part = 0; part < each; ++part) {
      const Vec4 value = values.element(each * i + part);
      if (!isFinite(Vec3(value)) || !std::isfinite(value.w)) fail("value {} is not finite", i);
      track.values.emplace_back(value);
    }
    if (components == 4 && !(glm::length(track.values[each * i + each / 2]) > 1e-6))
      fail("value {} is no quaternion", i);
  }
  return track;
}

// What never changes, as a track with one key.
AnimationTrack constant(DVec4 value) { return {Kind::step, {0}, {value}}; }

AnimationTrack orConstant(AnimationTrack track, const std::vector<double>& rest, DVec4 otherwise) {
  if (!track.times.empty()) return track;
  for (size_t i = 0; i < rest.size() && i < 4; ++i) otherwise[static_cast<int>(i)] = rest[i];
  return constant(otherwise);
}

// A clip without a name is called by its number.
std::string nameOfClip(const tinygltf::Model& model, size_t i) {
  const std::string& name = model.animations[i].name;
  return name.empty() ? std::to_string(i) : name;
}

std::string namesOfClips(const tinygltf::Model& model) {
  std::string names;
  for (size_t i = 0; i < model.animations.size(); ++i)
    names += (i == 0 ? "" : ", ") + nameOfClip(model, i);
  return names;
}

std::optional<size_t> chosenClip(const tinygltf::Model& model,
                                 const std::optional<std::string>& clip) {
  const size_t count = model.animations.size();
  if (clip) {
    for (size_t i = 0; i < count; ++i)
      if (nameOfClip(model, i) == *clip) return i;
    if (count == 0) fail("the file has no animation, so --clip {} names none", *clip);
    fail("it has no animation '{}'; there is: {}", *clip, namesOfClips(model));
  }
  if (count == 0) return std::nullopt;
  if (count > 1)
    log("{} animations in the file: {} plays; --clip NAME chooses among {}", count,
        nameOfClip(model, 0), namesOfClips(model));
  return 0;
}

// The largest of the keys, of any axis.
double largestOf(const AnimationTrack& track) {
  const size_t step = track.kind == Kind::cubic ? 3 : 1;
  double largest = 0;
  for (size_t i = step / 2; i < track.values.size(); i += step)
    largest = std::max(largest, maxAxis(DVec3(track.values[i])));
  return largest;
}

DVec3 restScale(const tinygltf::Node& node) {
  return node.scale.size() == 3 ? DVec3(node.scale[0], node.scale[1], node.scale[2]) : DVec3(1);
}

}  // namespace

GltfAnimations::GltfAnimations(const tinygltf::Model& model, const std::optional<std::string>& clip)
    : model_(&model) {
  const std::optional<size_t> chosen = chosenClip(model, clip);
  if (!chosen) return;
  const tinygltf::Animation& animation = model.animations[*chosen];
  for (size_t c = 0; c < animation.channels.size(); ++c) try {
      read(animation, animation.channels[c]);
    } catch (const Error& error) {
      fail("animation {} '{}', channel {}: {}", *chosen, animation.name, c, error.what());
    }
}

void GltfAnimations::read(const tinygltf::Animation& animation,
                          const tinygltf::AnimationChannel& channel) {
  const bool morphs = channel.target_path == "weights";
  const bool rotates = channel.target_path == "rotation", scales = channel.target_path == "scale";
  const bool known = morphs || rotates || scales || channel.target_path == "translation";
  const int node = channel.target_node;
  if (node < 0 || !known) return;  // to be left out, as glTF says
  if (static_cast<size_t>(node) >= model_->nodes.size()) fail("node {} does not exist", node);
  if (!morphs && !model_->nodes[static_cast<size_t>(node)].matrix.empty())
    fail(
        "node {} has a matrix and cannot be animated: export it with translation, rotation and "
        "scale",
        node);
  if (channel.sampler < 0 || static_cast<size_t>(channel.sampler) >= animation.samplers.size())
    fail("sampler {} does not exist", channel.sampler);
  if (morphs) return readWeights(animation.samplers[static_cast<size_t>(channel.sampler)], node);
  Tracks& tracks = tracks_[node];
  AnimationTrack& track = rotates ? tracks.rotation : scales ? tracks.scale : tracks.translation;
  if (!track.times.empty()) return;
  track = readTrack(*model_, animation.samplers[static_cast<size_t>(channel.sampler)],
                    rotates ? 4 : 3, kMaxKeys - keys_);
  keys_ += track.times.size();
}

// The values of a key stand together, for cubic tracks after those of its in-tangent.
void GltfAnimations::readWeights(const tinygltf::AnimationSampler& sampler, int node) {
  if (weights_.contains(node)) return;
  const AnimationTrack times = readTimes(*model_, sampler, kMaxKeys - keys_);
  const GltfAccessor values(*model_, sampler.output, 1, "output");
  const size_t each = valuesOfAKey(times.kind) * times.times.size();
  const size_t targets = values.count() / each;
  if (targets == 0 || values.count() != targets * each)
    fail("{} times and {} weights do not go together", times.times.size(), values.count());
  if (values.count() > kMaxKeys - keys_)
    fail("more than {} keys in the file: export fewer", kMaxKeys);
  keys_ += values.count();
  std::vector<AnimationTrack> tracks(targets, times);
  for (size_t i = 0; i < values.count(); ++i) {
    const float value = values.element(i).x;
    if (!std::isfinite(value)) fail("weight {} is not finite", i);
    tracks[i % targets].values.emplace_back(value, 0, 0, 0);
  }
  weights_[node] = std::move(tracks);
}

const std::vector<AnimationTrack>& GltfAnimations::weightsOf(int node, size_t targets) const {
  const std::vector<AnimationTrack>& tracks = weights_.at(node);
  if (tracks.size() != targets)
    fail("its animation has weights of {} morph targets, its mesh has {}", tracks.size(), targets);
  return tracks;
}

double GltfAnimations::largestScale(int index) const {
  const double rest = maxAxis(restScale(model_->nodes[static_cast<size_t>(index)]));
  const auto moved = tracks_.find(index);
  return moved == tracks_.end() ? rest : std::max(rest, largestOf(moved->second.scale));
}

DMat4 GltfAnimations::localMatrix(int index) const {
  tinygltf::Node node = model_->nodes[static_cast<size_t>(index)];
  if (node.matrix.empty() && node.scale.size() == 3) {
    const DVec3 scale = liftedScale(restScale(node), largestScale(index));
    node.scale = {scale.x, scale.y, scale.z};
  }
  return ninefold::localMatrix(node);
}

int GltfAnimations::enter(int index, int parent, const DMat4& above, const DMat4& toWorld) {
  const auto moved = tracks_.find(index);
  if (parent < 0 && moved == tracks_.end()) return -1;
  const tinygltf::Node& node = model_->nodes[static_cast<size_t>(index)];
  AnimatedNode& entry = nodes_.emplace_back();
  entry.node = index, entry.parent = parent, entry.above = above, entry.asRead = toWorld;
  if (moved == tracks_.end()) {
    entry.fixed = localMatrix(index);
  } else {
    entry.largestScale = largestScale(index);
    Tracks& tracks = moved->second;
    entry.translation = orConstant(std::move(tracks.translation), node.translation, DVec4(0));
    entry.rotation = orConstant(std::move(tracks.rotation), node.rotation, DVec4(0, 0, 0, 1));
    entry.scale = orConstant(std::move(tracks.scale), node.scale, DVec4(1));
  }
  return static_cast<int>(nodes_.size()) - 1;
}

}  // namespace ninefold
