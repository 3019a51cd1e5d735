// Prints what the two indexes of the photon map cost: photon_cells.h and photon_tree.h.
//
//   photons   n points, evenly on the six walls of a room and on a ball in it
//   build     of all n [ms]
//   renew     a twentieth of them goes and comes: the cells by erase and insert, the tree anew [ms]
//   find      the 100 nearest of a point on a wall, mean of 20,000 [us]
//
// Processor time, median of five. usage: photon-search-benchmark [N...]
#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <random>

#include "common/base/cpu_time.h"
#include "common/gi/photon_map/photon_cells.h"
#include "common/gi/photon_map/photon_tree.h"

namespace {

using namespace ninefold;

constexpr int kRuns = 5, kSearches = 20000;
constexpr size_t kNearest = 100;

double inMs(Duration d) { return 1e3 * seconds(d); }

// Median time of work(), which is told the number of the run.
template <typename Work>
double timeOf(const Work& work) {
  std::vector<double> times;
  for (int run = 0; run < kRuns; ++run) {
    const Duration start = threadCpuTime();
    work(run);
    times.push_back(inMs(threadCpuTime() - start));
  }
  std::nth_element(times.begin(), times.begin() + kRuns / 2, times.end());
  return times[kRuns / 2];
}

class Room {
 public:
  Vec3 somewhere() {
    Vec3 p(unit_(random_), unit_(random_), unit_(random_));
    if (random_() % 8 == 0) {
      const Vec3 d = 2.0f * p - 1.0f;
      return Vec3(0.5f) + 0.2f * glm::normalize(d + Vec3(1e-3f));
    }
    p[static_cast<int>(random_() % 3)] = random_() % 2 == 0 ? 0.0f : 1.0f;
    return p;
  }
  std::vector<NamedPoint> points(size_t n) {
    std::vector<NamedPoint> all(n);
    for (size_t i = 0; i < n; ++i) all[i] = {somewhere(), static_cast<uint32_t>(i)};
    return all;
  }

 private:
  std::mt19937 random_{1};
  std::uniform_real_distribution<float> unit_{0, 1};
};

uint64_t g_found = 0;  // so that nothing is left out

template <typename Index>
double findTime(const Index& index, const std::vector<Vec3>& from) {
  Nearest nearest;
  return timeOf([&](int) {
           for (const Vec3 x : from) {
             nearest.begin(kNearest, 1e30f);
             index.near(x, 1e30f, [&](float d2, uint32_t name) { return nearest.offer(d2, name); });
             g_found += static_cast<uint64_t>(nearest.farthest2() * 1e6f);
           }
         }) *
         1e3 / kSearches;
}

void measure(size_t n) {
  Room room;
  auto points = room.points(n);
  std::vector<Vec3> from(kSearches);
  for (Vec3& x : from) x = room.somewhere();
  PhotonCells cells;
  PhotonTree tree;
  const double buildCells = timeOf([&](int) { cells = PhotonCells(points); });
  const double buildTree = timeOf([&](int) { tree = PhotonTree(points); });
  const double findCells = findTime(cells, from), findTree = findTime(tree, from);
  const size_t part = n / 20;
  std::vector<Vec3> fresh(part * kRuns);
  for (Vec3& p : fresh) p = room.somewhere();
  const double renew = timeOf([&](int run) {
    for (size_t i = 0; i < part; ++i) {
      NamedPoint& p = points[static_cast<size_t>(run) * part + i];
      cells.erase(p);
      p.position = fresh[static_cast<size_t>(run) * part + i];
      cells.insert(p);
    }
  });
  fmt::print("{:>9} {:>10.3f} {:>10.3f} {:>10.3f} {:>10.2f} {:>10.2f}\n", n, buildCells, buildTree,
             renew, findCells, findTree);
}

}  // namespace

int main(int argc, char** argv) {
  fmt::print("{:>9} {:>10} {:>10} {:>10} {:>10} {:>10}\n", "photons", "cells", "tree", "renew",
             "cells", "tree");
  fmt::print("{:>9} {:>10} {:>10} {:>10} {:>10} {:>10}\n", "", "build/ms", "build/ms", "cells/ms",
             "find/us", "find/us");
  if (argc > 1)
    for (int i = 1; i < argc; ++i) measure(std::strtoull(argv[i], nullptr, 10));
  else
    for (const size_t n : {2000u, 10000u, 100000u, 1000000u, 2000000u}) measure(n);
  return g_found == 0 ? 1 : 0;
}
