#include "common/image/image.h"

#include <fmt/core.h>

#include <bit>

namespace ninefold {
namespace {

constexpr uint64_t kFnvOffset = 0xcbf29ce484222325, kFnvPrime = 0x100000001b3;

uint64_t addWord(uint64_t hash, uint32_t word) {
  for (int byte = 0; byte < 4; ++byte) hash = (hash ^ (word >> 8 * byte & 0xff)) * kFnvPrime;
  return hash;
}

}  // namespace

void appendLayer(const std::string& layer, const RgbPlane& plane, std::vector<Channel>& channels) {
  channels.push_back({layer + ".R", plane.r});
  channels.push_back({layer + ".G", plane.g});
  channels.push_back({layer + ".B", plane.b});
}

std::string imageHash(const RgbImage& image) {
  uint64_t hash = kFnvOffset;
  hash = addWord(hash, static_cast<uint32_t>(image.width));
  hash = addWord(hash, static_cast<uint32_t>(image.height));
  for (const auto* plane : {&image.pixels.r, &image.pixels.g, &image.pixels.b})
    for (const float value : *plane) hash = addWord(hash, std::bit_cast<uint32_t>(value));
  return fmt::format("{:016x}", hash);
}

}  // namespace ninefold
