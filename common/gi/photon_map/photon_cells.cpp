#include "common/gi/photon_map/photon_cells.h"

namespace ninefold {
namespace {

constexpr size_t kSample = 4096;  // points that tell the cell size
constexpr int kTrials = 4;
constexpr float kNearly = 1.6f;  // a factor by which cells may miss what is wanted of them

}  // namespace

PhotonCells::PhotonCells(std::span<const NamedPoint> points) {
  if (points.empty()) return;
  Vec3 low = points.front().position, high = low;
  for (const NamedPoint& p : points) {
    low = glm::min(low, p.position);
    high = glm::max(high, p.position);
  }
  const Vec3 size = high - low;
  const float longest = std::max(std::max(size.x, size.y), size.z);
  const float least = longest > 0 ? 2 * longest / kMostCells : 1.0f;
  // Of a sample, first as if it lay on the faces of a cube, then by what that gave.
  const size_t stride = (points.size() + kSample - 1) / kSample;
  std::vector<NamedPoint> sample;
  for (size_t i = 0; i < points.size(); i += stride) sample.push_back(points[i]);
  const auto count = static_cast<float>(sample.size());
  float h = std::max(longest * std::sqrt(6 * kWanted / count), least);
  for (int trial = 0; trial < kTrials; ++trial) {
    place(sample, low, high, h);
    const float mean = count / static_cast<float>(used_);
    if (mean < kNearly * kWanted && mean * kNearly > kWanted) break;
    h = std::max(h * std::sqrt(kWanted / mean), least);
  }
  // Photons lie on surfaces.
  if (stride > 1) h *= std::sqrt(count / static_cast<float>(points.size()));
  place(points, low, high, std::max(h, least));
}

void PhotonCells::place(std::span<const NamedPoint> points, Vec3 low, Vec3 high, float h) {
  h_ = h, inverse_ = 1 / double(h), low_ = low;
  const auto expected = static_cast<size_t>(static_cast<float>(points.size()) / kWanted);
  cells_.assign(std::bit_ceil(4 * expected + 16), Cell{});
  mask_ = cells_.size() - 1, used_ = size_ = 0;
  blocks_.clear(), spare_.clear();
  blocks_.reserve(points.size() / 6);
  for (int a = 0; a < 3; ++a) {
    const auto axis = static_cast<size_t>(a);
    from_[axis] = cell(low, a), to_[axis] = cell(high, a);
  }
  for (const NamedPoint& p : points) insert(p);
}

PhotonCells::Cell& PhotonCells::cellFor(uint64_t key) {
  for (size_t at = hashed(key) & mask_;; at = (at + 1) & mask_) {
    if (cells_[at].key == key) return cells_[at];
    if (cells_[at].key != kFree) continue;
    ++used_;
    cells_[at].key = key;
    return cells_[at];
  }
}

void PhotonCells::grow() {
  std::vector<Cell> old = std::move(cells_);
  cells_.assign(std::max<size_t>(2 * old.size(), 16), Cell{});
  mask_ = cells_.size() - 1, used_ = 0;
  for (const Cell& cell : old)
    if (cell.first != kNone) cellFor(cell.key).first = cell.first;
}

uint32_t PhotonCells::newBlock(uint32_t next) {
  uint32_t block = 0;
  if (spare_.empty()) {
    block = static_cast<uint32_t>(blocks_.size());
    blocks_.emplace_back();
  } else {
    block = spare_.back();
    spare_.pop_back();
  }
  blocks_[block].count = 0, blocks_[block].next = next;
  return block;
}

void PhotonCells::insert(const NamedPoint& point) {
  if (2 * (used_ + 1) > cells_.size()) grow();
  const std::array<int, 3> c{cell(point.position, 0), cell(point.position, 1),
                             cell(point.position, 2)};
  for (size_t a = 0; a < 3; ++a)
    from_[a] = std::min(from_[a], c[a]), to_[a] = std::max(to_[a], c[a]);
  Cell& cell = cellFor(packed(c[0], c[1], c[2]));
  if (cell.first == kNone || blocks_[cell.first].count == kLanes) {
    const uint32_t block = newBlock(cell.first);
    cell.first = block;
  }
  Block& b = blocks_[cell.first];
  b.x[b.count] = point.position.x, b.y[b.count] = point.position.y;
  b.z[b.count] = point.position.z, b.name[b.count] = point.name;
  ++b.count, ++size_;
}

void PhotonCells::erase(const NamedPoint& point) {
  Cell& cell = cellFor(keyOf(point.position));
  for (uint32_t block = cell.first; block != kNone; block = blocks_[block].next) {
    Block& b = blocks_[block];
    for (size_t i = 0; i < b.count; ++i) {
      if (b.name[i] != point.name) continue;
      // The newest of the cell takes its place.
      Block& newest = blocks_[cell.first];
      const size_t last = --newest.count;
      b.x[i] = newest.x[last], b.y[i] = newest.y[last], b.z[i] = newest.z[last];
      b.name[i] = newest.name[last];
      if (newest.count == 0) {
        spare_.push_back(cell.first);
        cell.first = newest.next;
      }
      --size_;
      return;
    }
  }
}

}  // namespace ninefold
