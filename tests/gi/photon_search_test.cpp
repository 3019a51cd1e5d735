// Both indexes of the pool find the m nearest that brute force finds: in the same order, of equally
// far ones the first by name, within a distance, after insertions and deletions, too.
#include <gtest/gtest.h>

#include <random>

#include "common/gi/photon_map/photon_cells.h"
#include "common/gi/photon_map/photon_tree.h"

namespace ninefold {
namespace {

constexpr float kAnywhere = 1e30f;

std::vector<NearKey> byBruteForce(const std::vector<NamedPoint>& points, Vec3 x, size_t m,
                                  float most2) {
  std::vector<NearKey> keys;
  for (const NamedPoint& p : points)
    if (const float d2 = squaredDistance(p.position, x); d2 <= most2)
      keys.push_back(nearKey(d2, p.name));
  std::sort(keys.begin(), keys.end());
  if (keys.size() > m) keys.resize(m);
  return keys;
}

template <typename Index>
std::vector<NearKey> byIndex(const Index& index, Vec3 x, size_t m, float most2) {
  Nearest nearest;
  nearest.begin(m, most2);
  index.near(x, most2, [&](float d2, uint32_t name) { return nearest.offer(d2, name); });
  return nearest.sorted();
}

// How points lie: evenly in a cube, on walls, on a lattice with many equally far ones, all but a
// few in one place, on a line far from the origin.
enum class Lie { cube, walls, lattice, clump, line };

class Points {
 public:
  Points(Lie lie, uint32_t seed) : lie_(lie), random_(seed) {}

  Vec3 somewhere() {
    Vec3 p(unit_(random_), unit_(random_), unit_(random_));
    if (lie_ == Lie::walls) p[static_cast<int>(random_() % 3)] = random_() % 2 == 0 ? 0.0f : 1.0f;
    if (lie_ == Lie::lattice) p = glm::floor(6.0f * p);
    if (lie_ == Lie::clump) p = random_() % 50 == 0 ? 1000.0f * p : 1e-3f * p;
    if (lie_ == Lie::line) p = Vec3(5000, 100.0f * p.y, -300);
    return p;
  }
  std::vector<NamedPoint> some(size_t count) {
    std::vector<NamedPoint> points;
    for (size_t i = 0; i < count; ++i) points.push_back({somewhere(), next_++});
    std::shuffle(points.begin(), points.end(), random_);
    return points;
  }
  std::mt19937& random() { return random_; }

 private:
  Lie lie_;
  std::mt19937 random_;
  std::uniform_real_distribution<float> unit_{0, 1};
  uint32_t next_ = 0;
};

constexpr Lie kAll[] = {Lie::cube, Lie::walls, Lie::lattice, Lie::clump, Lie::line};

TEST(PhotonSearch, TreeAndCellsFindWhatBruteForceFinds) {
  for (const Lie lie : kAll)
    for (const size_t count : {0u, 1u, 2u, 3u, 7u, 100u, 1023u, 5000u}) {
      Points make(lie, static_cast<uint32_t>(count) + 1);
      const auto points = make.some(count);
      const PhotonCells cells(points);
      const PhotonTree tree(points);
      EXPECT_EQ(cells.size(), count);
      EXPECT_EQ(tree.size(), count);
      for (int i = 0; i < 60; ++i) {
        const Vec3 x = i % 10 == 9 ? Vec3(-3, 2000, 7) : make.somewhere();
        const size_t m = i % 3 == 0 ? 1 : i % 3 == 1 ? 10 : 100;
        const float most2 = i % 4 == 0 ? 0.01f : kAnywhere;
        const auto expected = byBruteForce(points, x, m, most2);
        ASSERT_EQ(byIndex(cells, x, m, most2), expected)
            << "cells, lie " << static_cast<int>(lie) << ", " << count << " points, search " << i;
        ASSERT_EQ(byIndex(tree, x, m, most2), expected)
            << "tree, lie " << static_cast<int>(lie) << ", " << count << " points, search " << i;
      }
    }
}

// A ring as the pool is one: the oldest go, new ones come; once all of them have another form.
TEST(PhotonSearch, CellsTakeInsertionsAndDeletions) {
  for (const Lie lie : kAll) {
    Points make(lie, 77);
    std::vector<NamedPoint> points = make.some(1000);
    PhotonCells cells(points), fromNothing;
    for (const NamedPoint& p : points) fromNothing.insert(p);
    for (int round = 0; round < 30; ++round) {
      const size_t gone = make.random()() % 200, come = round == 20 ? 5000 : make.random()() % 200;
      for (size_t i = 0; i < std::min(gone, points.size()); ++i)
        for (PhotonCells* each : {&cells, &fromNothing}) each->erase(points[i]);
      points.erase(points.begin(),
                   points.begin() + static_cast<std::ptrdiff_t>(std::min(gone, points.size())));
      for (const NamedPoint& p : make.some(come)) {
        points.push_back(p);
        for (PhotonCells* each : {&cells, &fromNothing}) each->insert(p);
      }
      ASSERT_EQ(cells.size(), points.size());
      for (int i = 0; i < 10; ++i) {
        const Vec3 x = make.somewhere();
        const auto expected = byBruteForce(points, x, 50, kAnywhere);
        ASSERT_EQ(byIndex(cells, x, 50, kAnywhere), expected) << "round " << round;
        ASSERT_EQ(byIndex(fromNothing, x, 50, kAnywhere), expected) << "round " << round;
      }
    }
    for (const NamedPoint& p : points) cells.erase(p);
    EXPECT_EQ(cells.size(), 0u);
    EXPECT_TRUE(byIndex(cells, Vec3(0), 5, kAnywhere).empty());
  }
}

// All that lie within a radius that stays are visited once.
TEST(PhotonSearch, ARadiusThatStaysVisitsEachOnce) {
  for (const Lie lie : kAll) {
    Points make(lie, 5);
    const auto points = make.some(3000);
    const PhotonCells cells(points);
    const PhotonTree tree(points);
    for (int i = 0; i < 20; ++i) {
      const Vec3 x = make.somewhere();
      const float r2 = lie == Lie::lattice ? 4.0f : 0.04f;
      const auto expected = byBruteForce(points, x, points.size(), r2);
      const auto visited = [&](const auto& index) {
        std::vector<NearKey> keys;
        index.near(x, r2, [&](float d2, uint32_t name) {
          if (d2 <= r2) keys.push_back(nearKey(d2, name));
          return r2;
        });
        std::sort(keys.begin(), keys.end());
        return keys;
      };
      EXPECT_EQ(visited(cells), expected);
      EXPECT_EQ(visited(tree), expected);
    }
  }
}

}  // namespace
}  // namespace ninefold
