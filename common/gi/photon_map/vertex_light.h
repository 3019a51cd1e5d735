// vertex_light.h: E at the entries of map_vertices.h, filled as they are asked for.
//
// Whoever misses an entry finds its E and puts it here. Two threads may do so at once: E is a
// function of the entry, so that both put the same. Memory is taken for those that were asked for,
// by blocks of kBlock.
//
// Threads: all functions from any thread.   Errors: none.
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <vector>

#include "common/math/units.h"

namespace ninefold {

class VertexLight {
 public:
  explicit VertexLight(size_t entries) : blocks_((entries + kBlock - 1) / kBlock) {}
  ~VertexLight() {
    for (const auto& block : blocks_) delete block.load();
  }
  VertexLight(const VertexLight&) = delete;
  VertexLight& operator=(const VertexLight&) = delete;

  std::optional<Irradiance> find(uint32_t entry) const {
    const Block* block = blocks_[entry / kBlock].load(std::memory_order_acquire);
    if (block == nullptr) return std::nullopt;
    const Entry& e = (*block)[entry % kBlock];
    if (!e.isThere.load(std::memory_order_acquire)) return std::nullopt;
    return Irradiance(e.r.load(std::memory_order_relaxed), e.g.load(std::memory_order_relaxed),
                      e.b.load(std::memory_order_relaxed));
  }

  void put(uint32_t entry, Irradiance value) {
    Entry& e = (*blockOf(entry))[entry % kBlock];
    e.r.store(value.x, std::memory_order_relaxed), e.g.store(value.y, std::memory_order_relaxed);
    e.b.store(value.z, std::memory_order_relaxed);
    e.isThere.store(true, std::memory_order_release);
  }

  // How many entries are there.
  size_t count() const {
    size_t sum = 0;
    for (const auto& at : blocks_)
      if (const Block* block = at.load(std::memory_order_acquire))
        for (const Entry& e : *block) sum += e.isThere.load() ? 1 : 0;
    return sum;
  }

 private:
  static constexpr size_t kBlock = 64;
  struct Entry {
    std::atomic<float> r{0}, g{0}, b{0};
    std::atomic<bool> isThere{false};
  };
  using Block = std::array<Entry, kBlock>;

  Block* blockOf(uint32_t entry) {
    std::atomic<Block*>& at = blocks_[entry / kBlock];
    Block* block = at.load(std::memory_order_acquire);
    if (block != nullptr) return block;
    auto made = std::make_unique<Block>();
    if (at.compare_exchange_strong(block, made.get(), std::memory_order_acq_rel))
      return made.release();
    return block;
  }

  std::vector<std::atomic<Block*>> blocks_;
};

}  // namespace ninefold
