#include "master/assembly/view.h"

#include <algorithm>
#include <cmath>

#include "common/scene/settings_table.h"

namespace ninefold {
namespace {

constexpr size_t kDigits = 10;
constexpr float kPhotonDot = 0.004f;  // [R]

Vec3 at(const RgbPlane& plane, size_t i) { return Vec3(plane.r[i], plane.g[i], plane.b[i]); }

void put(RgbPlane& plane, size_t i, Vec3 v) {
  plane.r[i] = v.x, plane.g[i] = v.y, plane.b[i] = v.z;
}

Vec3 colorAt(PictureView view, const TileResult& planes, size_t i, float depthScale) {
  const ExtraPlanes& extras = planes.extras;
  switch (view) {
    case PictureView::albedo:
      return at(extras.albedo, i);
    case PictureView::normal: {
      const Vec3 n = at(extras.normal, i);
      return isBlack(n) ? n : 0.5f * (n + Vec3(1));
    }
    case PictureView::depth:
      return Vec3(extras.depth[i] / depthScale);
    case PictureView::caustics:
      return at(planes.layers[kDiffuse].reflectance, i) * at(extras.caustic, i);
    case PictureView::objects:
      return extras.object[i] == 0 ? Vec3(0) : colorOf(extras.object[i]);
    default:
      return Vec3(0);
  }
}

}  // namespace

std::optional<PictureView> viewNamed(const std::string& name) {
  const auto found = std::ranges::find(kViewNames, name);
  if (found == kViewNames.end()) return std::nullopt;
  return static_cast<PictureView>(found - kViewNames.begin());
}

std::optional<PictureView> viewOfKey(int digit, bool shift) {
  const size_t view = static_cast<size_t>(digit == 0 ? 9 : digit - 1) + (shift ? kDigits : 0);
  if (view >= kViewNames.size()) return std::nullopt;
  return static_cast<PictureView>(view);
}

std::string keyOf(PictureView view) {
  const auto place = static_cast<size_t>(view);
  const std::string digit = std::to_string((place + 1) % kDigits);
  return place < kDigits ? digit : "Shift+" + digit;
}

uint8_t planesOf(PictureView view) {
  switch (view) {
    case PictureView::albedo:
      return kAlbedoPlane;
    case PictureView::normal:
      return kNormalPlane;
    case PictureView::depth:
      return kDepthPlane;
    case PictureView::caustics:
      return kCausticPlane;
    case PictureView::objects:
      return kObjectPlane;
    default:
      return 0;
  }
}

// All hits within a dot's radius, blurred over no more than that, and nothing else.
Settings photonsAlone(Settings s) {
  s.mapEstimate = MapEstimate::pixels;
  s.mapDistance = kPhotonDot;
  s.mapNearest = static_cast<int>(settingOf(&Settings::mapNearest).high);
  s.caustics = Caustics::off, s.compensate = false;
  if (s.mapDirect == MapDirect::off) s.directVpls = 0;
  return s;
}

// Direct light is that of paths with one diffuse vertex; indirect light that of VPLs off the lamps.
Settings settingsFor(PictureView view, Settings settings) {
  if (view == PictureView::direct) settings.pathLength = 1, settings.caustics = Caustics::off;
  if (view == PictureView::indirect) settings.directVpls = 0;
  const bool hasPool = factsOf(settings.method).has(kMapPhotons);
  return view == PictureView::photons && hasPool ? photonsAlone(settings) : settings;
}

bool isLight(PictureView view) {
  return view == PictureView::beauty || view == PictureView::direct ||
         view == PictureView::indirect || view == PictureView::photons;
}

bool isFalseColor(PictureView view) { return !isLight(view) && view != PictureView::caustics; }

Vec3 colorOf(uint32_t number) {
  const float hue = std::fmod(0.618034f * static_cast<float>(number), 1.0f) * 6;
  const auto channel = [hue](float shift) {
    const float d = std::abs(std::fmod(hue + shift, 6.0f) - 3) - 1;
    return 0.15f + 0.7f * std::clamp(d, 0.0f, 1.0f);
  };
  return {channel(0), channel(4), channel(2)};
}

void paint(PictureView view, const Patch& patch, const PatchFilter& filter, float neighbourWeight,
           uint32_t rotation, float depthScale, const uint32_t* owners, RgbImage& beauty) {
  if (view == PictureView::weights) return filter.paintShares(patch, neighbourWeight, beauty);
  if (planesOf(view) == 0 && view != PictureView::sets && view != PictureView::clients) return;
  for (int phase = 0; phase < patch.phases(); ++phase) {
    const uint32_t number =
        view == PictureView::sets
            ? static_cast<uint32_t>(lightSetOfPhase(phase, rotation, patch.phases()))
            : (owners != nullptr ? owners[phase] : 0);
    const bool byNumber = view == PictureView::sets || view == PictureView::clients;
    patch.forEachPixel(phase, [&](size_t from, int x, int y) {
      put(beauty.pixels, beauty.at(x - patch.x0(), y - patch.y0()),
          byNumber ? colorOf(number) : colorAt(view, patch.phase(phase), from, depthScale));
    });
  }
}

void paintError(const Film& film, int64_t frames, const TaskRect& tile, RgbImage& mean) {
  for (int y = tile.j0; y < tile.j0 + tile.height; ++y)
    for (int x = tile.i0; x < tile.i0 + tile.width; ++x) {
      const size_t i = mean.at(x, y);
      const float relative =
          film.standardError(i, frames) / std::max(1e-6f, luminance(mean.rgb(i)));
      mean.pixels.r[i] = mean.pixels.g[i] = mean.pixels.b[i] = relative;
    }
}

}  // namespace ninefold
