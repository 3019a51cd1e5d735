#include "proto/byte_planes.h"

#include <algorithm>
#include <array>

namespace ninefold {
namespace {

enum Mode : uint8_t { kZero = 0, kConstant = 1, kPlain = 2, kDifferences = 3 };

// How often a difference or value meets itself again: the larger, the fewer bits zstd needs. Every
// fourth byte tells enough.
uint64_t repetition(const std::array<uint32_t, 256>& histogram) {
  uint64_t sum = 0;
  for (const uint64_t count : histogram) sum += count * count;
  return sum;
}

bool differencesPay(std::span<const uint8_t> plane) {
  std::array<uint32_t, 256> values{}, differences{};
  for (size_t i = 1; i < plane.size(); i += 4) {
    ++values[plane[i]];
    ++differences[static_cast<uint8_t>(plane[i] - plane[i - 1])];
  }
  return repetition(differences) > repetition(values);
}

void writeDifferences(std::span<const uint8_t> plane, size_t width, Bytes& out) {
  const size_t first = out.size();
  out.resize(first + plane.size());
  auto* to = reinterpret_cast<uint8_t*>(out.data() + first);
  to[0] = plane[0];
  for (size_t i = 1; i < plane.size(); ++i) to[i] = static_cast<uint8_t>(plane[i] - plane[i - 1]);
  for (size_t row = width; row < plane.size(); row += width)
    to[row] = static_cast<uint8_t>(plane[row] - plane[row - width]);
}

// Running sums of eight bytes, the first one in the lowest bits, that begin at `sum`; adds them all
// to it. Bytes of even and of odd places are summed apart, in lanes of sixteen bits, where no sum
// runs over. The next eight have to wait for one addition only.
uint64_t runningSums(uint64_t bytes, uint64_t& sum) {
  constexpr uint64_t kLow = 0x00ff00ff00ff00ff, kOnes = 0x0001000100010001;
  const uint64_t even = (bytes & kLow) * kOnes, odd = (bytes >> 8 & kLow) * kOnes;
  const uint64_t before = (sum & 0xff) * kOnes;
  sum += (even + odd) >> 48;
  return ((even + (odd << 16) + before) & kLow) | ((even + odd + before) & kLow) << 8;
}

void addDifferences(std::span<uint8_t> plane, size_t width) {
  for (size_t row = 0; row < plane.size(); row += width) {
    uint64_t sum = row > 0 ? plane[row - width] : 0;
    size_t i = row;
    for (uint64_t bytes; i + sizeof bytes <= row + width; i += sizeof bytes) {
      std::memcpy(&bytes, &plane[i], sizeof bytes);
      bytes = runningSums(bytes, sum);
      std::memcpy(&plane[i], &bytes, sizeof bytes);
    }
    for (; i < row + width; ++i) plane[i] = static_cast<uint8_t>(sum += plane[i]);
  }
}

}  // namespace

void writePlane(std::span<const uint8_t> plane, size_t width, bool mayDiffer, Bytes& out) {
  NINEFOLD_CHECK(!plane.empty());
  NINEFOLD_CHECK(plane.size() % width == 0);
  ByteWriter writer(out);
  const uint8_t first = plane.front();
  if (std::all_of(plane.begin(), plane.end(), [=](uint8_t b) { return b == first; })) {
    writer.number<uint8_t>(first == 0 ? kZero : kConstant);
    if (first != 0) writer.number(first);
    return;
  }
  const bool differences = mayDiffer && differencesPay(plane);
  writer.number<uint8_t>(differences ? kDifferences : kPlain);
  if (differences)
    writeDifferences(plane, width, out);
  else
    writer.raw(plane.data(), plane.size());
}

void writeZeroPlane(Bytes& out) { ByteWriter(out).number<uint8_t>(kZero); }

PlaneView openPlane(MutableReader& in, size_t width, size_t size) {
  const auto mode = in.number<uint8_t>("plane mode");
  switch (mode) {
    case kZero:
      return {};
    case kConstant:
      return {nullptr, in.number<uint8_t>("plane value")};
    case kPlain:
    case kDifferences: {
      const std::span<uint8_t> plane = in.take(size, "plane");
      if (mode == kDifferences) addDifferences(plane, width);
      return {plane.data(), 0};
    }
    default:
      fail("{}: plane mode {} is unknown; it is damaged", in.what(), mode);
  }
}

}  // namespace ninefold
