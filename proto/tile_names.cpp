#include "proto/tile_names.h"

#include <fmt/format.h>

#include <array>
#include <vector>

#include "common/image/layers.h"

namespace ninefold {
namespace {

constexpr std::array kOfLayer{"reflectance", "E", "U", "distance", "normal", "chain"};
constexpr std::array kLayerNames{"diffuse", "reflection", "transmission"};
constexpr std::array kExtra{"albedo", "first normal", "depth", "object", "caustic E", "first E"};
static_assert(kExtra.size() == kExtraPlanes);
constexpr uint32_t kFirstExtra = kOfLayer.size() * kLayers;
constexpr uint32_t kFinished = kFirstExtra + kExtra.size();
static_assert(kAllTileFields == (2u << kFinished) - 1);

std::string nameOfField(uint32_t bit) {
  if (bit == kFinished) return "radiance";
  if (bit >= kFirstExtra) return kExtra[bit - kFirstExtra];
  return fmt::format("{} ({})", kOfLayer[bit % kOfLayer.size()],
                     kLayerNames[bit / kOfLayer.size()]);
}

}  // namespace

uint32_t fieldBits(uint32_t places, uint8_t layerMask, uint8_t extraMask) {
  if (isFinished(layerMask)) return places != 0 ? 1u << kFinished : 0;
  std::vector<uint32_t> bitOfPlace;
  for (uint32_t bit = 0; bit < kFinished; ++bit) {
    const bool there = bit < kFirstExtra
                           ? hasLayer(layerMask, static_cast<int>(bit / kOfLayer.size()))
                           : (extraMask >> (bit - kFirstExtra) & 1) != 0;
    if (there) bitOfPlace.push_back(bit);
  }
  uint32_t bits = 0;
  for (size_t place = 0; place < bitOfPlace.size(); ++place)
    if ((places >> place & 1) != 0) bits |= 1u << bitOfPlace[place];
  return bits;
}

std::string namesOfFields(uint32_t bits) {
  std::string names;
  for (uint32_t bit = 0; bit <= kFinished; ++bit)
    if ((bits >> bit & 1) != 0) names += (names.empty() ? "" : ", ") + nameOfField(bit);
  return names;
}

}  // namespace ninefold
