#include "common/image/aov_film.h"

#include "common/base/error.h"

namespace ninefold {
namespace {

using Rgb = std::array<std::vector<double>, 3>;

// Calls f(index in the patch's planes, index in the image) for its own pixels of a phase.
template <typename F>
void forEachPixel(const Patch& patch, int phase, const F& f) {
  patch.forEachPixel(phase, [&](size_t from, int x, int y) {
    f(from, pixelCount(patch.grid().width(), y) + static_cast<size_t>(x));
  });
}

// The next frame's values into means over `frames` of them. `plane`: null: all black.
void addRgb(const Patch& patch, int phase, const RgbPlane* plane, int64_t frames, Rgb& means) {
  const double share = 1.0 / static_cast<double>(frames + 1);
  forEachPixel(patch, phase, [&](size_t from, size_t pixel) {
    const auto add = [&](size_t channel, float value) {
      means[channel][pixel] += (static_cast<double>(value) - means[channel][pixel]) * share;
    };
    add(0, plane != nullptr ? plane->r[from] : 0);
    add(1, plane != nullptr ? plane->g[from] : 0);
    add(2, plane != nullptr ? plane->b[from] : 0);
  });
}

std::vector<float> rounded(const std::vector<double>& means) {
  return {means.begin(), means.end()};
}

void appendMeans(const std::string& layer, const Rgb& means, std::vector<Channel>& out) {
  appendLayer(layer, {rounded(means[0]), rounded(means[1]), rounded(means[2])}, out);
}

// Unit again; zero where no frame met a surface.
void appendNormal(const Rgb& means, std::vector<Channel>& out) {
  const size_t n = means[0].size(), first = out.size();
  for (const char* name : {"N.x", "N.y", "N.z"}) out.push_back({name, std::vector<float>(n)});
  for (size_t i = 0; i < n; ++i) {
    const DVec3 mean(means[0][i], means[1][i], means[2][i]);
    const double length = glm::length(mean);
    for (int c = 0; c < 3; ++c)
      out[first + static_cast<size_t>(c)].values[i] =
          length > 0 ? static_cast<float>(mean[c] / length) : 0.0f;
  }
}

void appendDepth(const std::vector<double>& sums, const std::vector<uint32_t>& hits,
                 std::vector<Channel>& out) {
  Channel channel{"Z", std::vector<float>(sums.size())};
  for (size_t i = 0; i < sums.size(); ++i)
    channel.values[i] = hits[i] > 0 ? static_cast<float>(sums[i] / hits[i]) : 0.0f;
  out.push_back(std::move(channel));
}

}  // namespace

AovFilm::AovFilm(const TileGrid& grid, uint8_t extraMask) : grid_(grid), extraMask_(extraMask) {
  clear();
}

void AovFilm::clear() {
  const size_t n = pixelCount(grid_.width(), grid_.height());
  frames_ = 0;
  const auto clearRgb = [&](Rgb& means, int mask) {
    for (std::vector<double>& mean : means) mean.assign((extraMask_ & mask) != 0 ? n : 0, 0);
  };
  clearRgb(albedo_, kAlbedoPlane);
  clearRgb(normal_, kNormalPlane);
  clearRgb(caustic_, kCausticPlane);
  for (std::vector<double>& mean : irradiance_) mean.assign(n, 0);
  depth_.assign((extraMask_ & kDepthPlane) != 0 ? n : 0, 0);
  hits_.assign(depth_.size(), 0);
  object_.assign((extraMask_ & kObjectPlane) != 0 ? n : 0, 0);
}

void AovFilm::addPatch(const Patch& patch) {
  NINEFOLD_CHECK(patch.extraMask() == extraMask_);
  for (int phase = 0; phase < patch.phases(); ++phase) {
    const ExtraPlanes& extras = patch.phase(phase).extras;
    const auto add = [&](int mask, const RgbPlane& plane, Rgb& means) {
      if ((extraMask_ & mask) != 0) addRgb(patch, phase, &plane, frames_, means);
    };
    add(kAlbedoPlane, extras.albedo, albedo_);
    add(kNormalPlane, extras.normal, normal_);
    add(kCausticPlane, extras.caustic, caustic_);
    // Unfiltered: these means are to tend to the truth.
    if ((extraMask_ & kIrradiancePlane) != 0)
      addRgb(patch, phase, &extras.irradiance, frames_, irradiance_);
    else
      addRgb(patch, phase,
             patch.isDark(kDiffuse) ? nullptr : &patch.phase(phase).layers[kDiffuse].irradiance,
             frames_, irradiance_);
    if ((extraMask_ & kDepthPlane) != 0)
      forEachPixel(patch, phase, [&](size_t from, size_t pixel) {
        depth_[pixel] += static_cast<double>(extras.depth[from]);
        hits_[pixel] += extras.depth[from] > 0;
      });
    if ((extraMask_ & kObjectPlane) != 0)
      forEachPixel(patch, phase, [&](size_t from, size_t pixel) {
        object_[pixel] = static_cast<float>(extras.object[from]);
      });
  }
}

std::vector<Channel> AovFilm::channels() const {
  std::vector<Channel> out;
  if ((extraMask_ & kAlbedoPlane) != 0) appendMeans("albedo", albedo_, out);
  if ((extraMask_ & kNormalPlane) != 0) appendNormal(normal_, out);
  if ((extraMask_ & kDepthPlane) != 0) appendDepth(depth_, hits_, out);
  appendMeans("irradiance", irradiance_, out);
  if ((extraMask_ & kCausticPlane) != 0) appendMeans("caustic", caustic_, out);
  if ((extraMask_ & kObjectPlane) != 0) out.push_back({"objectId", object_});
  return out;
}

}  // namespace ninefold
