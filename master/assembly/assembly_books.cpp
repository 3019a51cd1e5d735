#include "master/assembly/assembly_books.h"

#include "common/base/error.h"

namespace ninefold {

size_t AssemblyBooks::taskIndex(const Frame& frame, int tile, int phase) {
  return static_cast<size_t>(tile * frame.grid.interleave().sets() + phase);
}

void AssemblyBooks::open(uint32_t number, const TileGrid& grid, bool filtered) {
  const auto tiles = static_cast<size_t>(grid.tiles());
  Frame frame{.grid = grid,
              .reach = filtered ? 0 : 1,
              .there = std::vector<bool>(static_cast<size_t>(grid.tasks()), false),
              .missing = std::vector<int>(tiles, 0),
              .users = std::vector<int>(tiles, 0),
              .ready = {},
              .left = grid.tiles()};
  for (int tile = 0; tile < grid.tiles(); ++tile) {
    int tasks = 0;  // tasks without pixels are never sent
    for (int phase = 0; phase < (filtered ? 1 : grid.interleave().sets()); ++phase)
      tasks += grid.rect(tile, phase).count() > 0 ? 1 : 0;
    forEachAround(grid, tile, frame.reach, [&](int t) {
      frame.missing[static_cast<size_t>(t)] += tasks;
      ++frame.users[static_cast<size_t>(t)];
    });
  }
  NINEFOLD_CHECK(frames_.emplace(number, std::move(frame)).second);
}

bool AssemblyBooks::isWanted(uint32_t number, int tile, int phase) const {
  const auto found = frames_.find(number);
  return found != frames_.end() && !found->second.there.at(taskIndex(found->second, tile, phase));
}

void AssemblyBooks::place(uint32_t number, int tile, int phase) {
  NINEFOLD_CHECK(isWanted(number, tile, phase));
  Frame& frame = frames_.at(number);
  frame.there[taskIndex(frame, tile, phase)] = true;
  forEachAround(frame.grid, tile, frame.reach, [&](int t) {
    if (--frame.missing[static_cast<size_t>(t)] == 0) frame.ready.push_back(t);
  });
}

std::optional<uint32_t> AssemblyBooks::front() const {
  return frames_.empty() ? std::nullopt : std::optional(frames_.begin()->first);
}

bool AssemblyBooks::hasTile() const {
  return !frames_.empty() && !frames_.begin()->second.ready.empty();
}

std::optional<int> AssemblyBooks::nextTile() {
  if (!hasTile()) return std::nullopt;
  std::vector<int>& ready = frames_.begin()->second.ready;
  const int tile = ready.back();
  ready.pop_back();
  return tile;
}

std::vector<int> AssemblyBooks::tileDone(uint32_t number, int tile) {
  Frame& frame = frames_.at(number);
  --frame.left;
  std::vector<int> unused;
  forEachAround(frame.grid, tile, frame.reach, [&](int t) {
    if (--frame.users[static_cast<size_t>(t)] == 0) unused.push_back(t);
  });
  return unused;
}

bool AssemblyBooks::isDone(uint32_t number) const { return frames_.at(number).left == 0; }

void AssemblyBooks::close(uint32_t number) { frames_.erase(number); }

}  // namespace ninefold
