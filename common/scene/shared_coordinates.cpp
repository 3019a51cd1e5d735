#include "common/scene/shared_coordinates.h"

#include <cmath>

#include "common/base/log.h"
#include "common/scene/texel_maps.h"

namespace ninefold {
namespace {

bool repeatsInSquare(const MtlMap& map) {
  constexpr float kMost = 16;  // images would become too large
  const auto fits = [](float s) { return s == std::round(s) && s != 0 && std::abs(s) <= kMost; };
  return !map.clamp && fits(map.scale.x) && fits(map.scale.y);
}

bool areAlike(const MtlMap& a, const MtlMap& b) {
  return a.scale == b.scale && a.offset == b.offset && a.clamp == b.clamp;
}

}  // namespace

// v points up in the file: 1 - v' = 1 - (s v + o) = s (1 - v) + 1 - s - o.
TextureUse useOf(int image, const MtlMap& map) {
  TextureUse use;
  use.image = image;
  use.scale = map.scale;
  use.offset = Vec2(map.offset.x, 1 - map.scale.y - map.offset.y);
  if (map.clamp) use.wrapS = use.wrapT = Wrap::clamp;
  return use;
}

SharedCoordinates::SharedCoordinates(const MtlMaterial& material, const MtlMap& a, const MtlMap& b,
                                     const char* names)
    : own_(a ? &a : &b) {
  if (!a || !b || areAlike(a, b)) return;
  square_ = repeatsInSquare(a) && repeatsInSquare(b);
  if (!square_)
    warn("material '{}': {} have different -s, -o or -clamp: the second has those of the first",
         material.name, names);
}

TextureUse SharedCoordinates::use(int image) const {
  return useOf(image, square_ ? MtlMap() : *own_);
}

TextureImage SharedCoordinates::place(const TextureImage& image, const MtlMap& map) const {
  return square_ ? asSeenBy(useOf(0, map), image) : image;
}

std::string SharedCoordinates::nameOf(const MtlMap& map) const {
  if (!square_) return {};
  return fmt::format(" at {} {} {} {}", map.scale.x, map.scale.y, map.offset.x, map.offset.y);
}

}  // namespace ninefold
