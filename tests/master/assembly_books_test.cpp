#include "master/assembly/assembly_books.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace ninefold {
namespace {

// Five by three tiles, the last ones of few pixels; some tasks without any.
const TileGrid kGrid(4 * 96 + 2, 2 * 64 + 1, {3, 2});

std::vector<std::pair<int, int>> tasksOf(const TileGrid& grid) {
  std::vector<std::pair<int, int>> tasks;
  for (int tile = 0; tile < grid.tiles(); ++tile)
    for (int phase = 0; phase < grid.interleave().sets(); ++phase)
      if (grid.rect(tile, phase).count() > 0) tasks.emplace_back(tile, phase);
  return tasks;
}

// In any order of results: each tile is handed out once, as soon as all around it is there and not
// before, and its results are kept as long as a tile around it is not done.
TEST(AssemblyBooks, ATileIsReadyWhenAllAroundItIsThere) {
  std::mt19937 random(5);
  for (int run = 0; run < 20; ++run) {
    AssemblyBooks books;
    books.open(7, kGrid, false);
    auto tasks = tasksOf(kGrid);
    std::ranges::shuffle(tasks, random);
    std::vector<int> toCome(static_cast<size_t>(kGrid.tiles()), 0);
    for (const auto& [tile, phase] : tasks) ++toCome[static_cast<size_t>(tile)];
    std::set<int> handedOut, done, unused;
    for (const auto& [tile, phase] : tasks) {
      ASSERT_TRUE(books.isWanted(7, tile, phase));
      books.place(7, tile, phase);
      ASSERT_FALSE(books.isWanted(7, tile, phase));
      --toCome[static_cast<size_t>(tile)];
      while (const auto next = books.nextTile()) ASSERT_TRUE(handedOut.insert(*next).second);
      for (int t = 0; t < kGrid.tiles(); ++t) {
        bool complete = true;
        forEachAround(kGrid, t, 1, [&](int a) { complete &= toCome[static_cast<size_t>(a)] == 0; });
        ASSERT_EQ(handedOut.contains(t), complete) << t;
      }
    }
    for (const int tile : handedOut) {
      ASSERT_FALSE(books.isDone(7));
      done.insert(tile);
      for (const int u : books.tileDone(7, tile)) ASSERT_TRUE(unused.insert(u).second);
      for (int t = 0; t < kGrid.tiles(); ++t) {
        bool allDone = true;
        forEachAround(kGrid, t, 1, [&](int a) { allDone &= done.contains(a); });
        ASSERT_EQ(unused.contains(t), allDone) << t;
      }
    }
    EXPECT_TRUE(books.isDone(7));
  }
}

TEST(AssemblyBooks, OnlyTheFrontFramesTilesAreHandedOut) {
  const TileGrid grid(96, 96, {3, 3});
  AssemblyBooks books;
  books.open(4, grid, false);
  books.open(5, grid, false);
  for (const auto& [tile, phase] : tasksOf(grid)) books.place(5, tile, phase);
  EXPECT_FALSE(books.hasTile());
  for (const auto& [tile, phase] : tasksOf(grid)) books.place(4, tile, phase);
  EXPECT_EQ(books.front(), 4u);
  EXPECT_EQ(books.nextTile(), 0);
  EXPECT_FALSE(books.hasTile()) << "frame 5 waits until 4 is closed";
  books.tileDone(4, 0);
  books.close(4);
  EXPECT_EQ(books.nextTile(), 0);
  EXPECT_FALSE(books.isWanted(4, 0, 0));
}

TEST(AssemblyBooks, ATileThatComesFilteredWaitsForNoOther) {
  AssemblyBooks books;
  books.open(1, kGrid, true);
  for (int tile = 0; tile < kGrid.tiles(); ++tile) {
    books.place(1, tile, 0);
    EXPECT_EQ(books.nextTile(), tile);
    EXPECT_EQ(books.tileDone(1, tile), std::vector<int>{tile});
  }
  EXPECT_TRUE(books.isDone(1));
}

}  // namespace
}  // namespace ninefold
