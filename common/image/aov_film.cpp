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

void addRgb(const Patch& patch, int phase, const RgbPlane& plane, Rgb& sums) {
  forEachPixel(patch, phase, [&](size_t from, size_t pixel) {
    sums[0][pixel] += static_cast<double>(plane.r[from]);
    sums[1][pixel] += static_cast<double>(plane.g[from]);
    sums[2][pixel] += static_cast<double>(plane.b[from]);
  });
}

std::vector<float> scaled(const std::vector<double>& sums, double scale) {
  std::vector<float> out(sums.size());
  for (size_t i = 0; i < out.size(); ++i) out[i] = static_cast<float>(sums[i] * scale);
  return out;
}

void appendMeans(const std::string& layer, const Rgb& sums, double share,
                 std::vector<Channel>& out) {
  appendLayer(layer, {scaled(sums[0], share), scaled(sums[1], share), scaled(sums[2], share)}, out);
}

// Unit again; zero where no frame met a surface.
void appendNormal(const Rgb& sums, std::vector<Channel>& out) {
  const size_t n = sums[0].size(), first = out.size();
  for (const char* name : {"N.x", "N.y", "N.z"}) out.push_back({name, std::vector<float>(n)});
  for (size_t i = 0; i < n; ++i) {
    const DVec3 sum(sums[0][i], sums[1][i], sums[2][i]);
    const double length = glm::length(sum);
    for (int c = 0; c < 3; ++c)
      out[first + static_cast<size_t>(c)].values[i] =
          length > 0 ? static_cast<float>(sum[c] / length) : 0.0f;
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
  const auto clearRgb = [&](Rgb& sums, int mask) {
    for (std::vector<double>& sum : sums) sum.assign((extraMask_ & mask) != 0 ? n : 0, 0);
  };
  clearRgb(albedo_, kAlbedoPlane);
  clearRgb(normal_, kNormalPlane);
  clearRgb(caustic_, kCausticPlane);
  for (std::vector<double>& sum : irradiance_) sum.assign(n, 0);
  depth_.assign((extraMask_ & kDepthPlane) != 0 ? n : 0, 0);
  hits_.assign(depth_.size(), 0);
  object_.assign((extraMask_ & kObjectPlane) != 0 ? n : 0, 0);
}

void AovFilm::addPatch(const Patch& patch) {
  NINEFOLD_CHECK(patch.extraMask() == extraMask_);
  for (int phase = 0; phase < patch.phases(); ++phase) {
    const ExtraPlanes& extras = patch.phase(phase).extras;
    if ((extraMask_ & kAlbedoPlane) != 0) addRgb(patch, phase, extras.albedo, albedo_);
    if ((extraMask_ & kNormalPlane) != 0) addRgb(patch, phase, extras.normal, normal_);
    if ((extraMask_ & kCausticPlane) != 0) addRgb(patch, phase, extras.caustic, caustic_);
    const bool isWhole = (extraMask_ & kIrradiancePlane) != 0;
    // Unfiltered: these means are to tend to the truth.
    if (isWhole)
      addRgb(patch, phase, extras.irradiance, irradiance_);
    else if (!patch.isDark(kDiffuse))
      addRgb(patch, phase, patch.phase(phase).layers[kDiffuse].irradiance, irradiance_);
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
  const double share = frames_ > 0 ? 1.0 / static_cast<double>(frames_) : 0;
  if ((extraMask_ & kAlbedoPlane) != 0) appendMeans("albedo", albedo_, share, out);
  if ((extraMask_ & kNormalPlane) != 0) appendNormal(normal_, out);
  if ((extraMask_ & kDepthPlane) != 0) appendDepth(depth_, hits_, out);
  appendMeans("irradiance", irradiance_, share, out);
  if ((extraMask_ & kCausticPlane) != 0) appendMeans("caustic", caustic_, share, out);
  if ((extraMask_ & kObjectPlane) != 0) out.push_back({"objectId", object_});
  return out;
}

}  // namespace ninefold
