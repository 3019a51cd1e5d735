// The hashed grid against brute force: what it finds, how often, and in which order, whatever the
// coordinates.
#include "common/gi/photons/photon_grid.h"

#include <gtest/gtest.h>

#include <random>

namespace ninefold {
namespace {

std::vector<Photon> cloud(size_t count, Vec3 centre, float side, uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(-side / 2, side / 2);
  std::vector<Photon> photons(count);
  for (size_t i = 0; i < count; ++i) {
    photons[i].position = centre + Vec3(uniform(random), uniform(random), uniform(random));
    photons[i].flux = Vec3(static_cast<float>(i + 1));
  }
  return photons;
}

size_t bruteForce(const std::vector<Photon>& photons, Vec3 x, float radius) {
  size_t found = 0;
  for (const Photon& p : photons)
    found += glm::dot(p.position - x, p.position - x) <= radius * radius ? 1 : 0;
  return found;
}

TEST(PhotonGrid, FindsWhatBruteForceFindsAndNothingTwice) {
  for (const Vec3 centre : {Vec3(0), Vec3(-7, 3, -2), Vec3(1e5f, -1e5f, 3e5f)}) {
    const auto photons = cloud(2000, centre, 2, 7);
    for (const float radius : {0.03f, 0.3f, 3.0f}) {
      const PhotonGrid grid(photons, radius);
      ASSERT_EQ(grid.size(), photons.size());
      for (const Photon& query : cloud(100, centre, 2.2f, 8)) {
        size_t found = 0;
        std::vector<bool> seen(photons.size() + 1);
        grid.near(query.position, query.position, [&](const Photon& p) {
          ++found;
          EXPECT_FALSE(seen[static_cast<size_t>(p.flux.x)]) << "twice";
          seen[static_cast<size_t>(p.flux.x)] = true;
        });
        ASSERT_EQ(found, bruteForce(photons, query.position, radius)) << "radius " << radius;
      }
    }
  }
}

TEST(PhotonGrid, HoldsNoneAndOne) {
  size_t found = 0;
  PhotonGrid().near(Vec3(0), Vec3(0), [&](const Photon&) { ++found; });
  PhotonGrid({}, 0.1f).near(Vec3(0), Vec3(0), [&](const Photon&) { ++found; });
  EXPECT_EQ(found, 0u);
  PhotonGrid({Photon{Vec3(1, 2, 3), Vec3(0, 1, 0), Vec3(1), 0}}, 0.1f)
      .near(Vec3(1, 2, 3), Vec3(1, 2, 3), [&](const Photon&) { ++found; });
  EXPECT_EQ(found, 1u);
}

// A radius that shrinks towards zero numbers cells by integers far beyond 32 bits.
TEST(PhotonGrid, TinyRadiusAndHugeCoordinatesDoNotOverflow) {
  for (const float radius : {1e-12f, 1e-30f}) {
    const auto photons = cloud(500, Vec3(1e6f), 1e5f, 9);
    const PhotonGrid grid(photons, radius);
    for (const Photon& p : photons) {
      size_t found = 0;
      grid.near(p.position, p.position, [&](const Photon&) { ++found; });
      EXPECT_EQ(found, bruteForce(photons, p.position, radius));
    }
  }
}

// Many photons in few cells and few slots: strangers that share a slot are told apart by distance.
TEST(PhotonGrid, CollidingCellsAreToldApart) {
  auto photons = cloud(50, Vec3(0), 100, 10);
  const PhotonGrid grid(photons, 0.01f);
  for (const Photon& p : photons) {
    size_t found = 0;
    const Vec3 x = p.position + Vec3(0.005f, 0, 0);
    grid.near(x, x, [&](const Photon&) { ++found; });
    EXPECT_EQ(found, bruteForce(photons, x, 0.01f));
  }
}

// A box finds what each point in it finds, or says that it is too large; halves come to an end.
TEST(PhotonGrid, ABoxFindsWhatItsPointsFind) {
  const float radius = 0.1f;
  const auto photons = cloud(3000, Vec3(0), 2, 11);
  const PhotonGrid grid(photons, radius);
  int refused = 0;
  for (const float side : {0.01f, 0.2f, 0.5f, 2.0f})
    for (const Photon& middle : cloud(50, Vec3(0), 2, 12)) {
      const auto points = cloud(16, middle.position, side, 13);
      Vec3 low = points[0].position, high = low;
      for (const Photon& p : points)
        low = glm::min(low, p.position), high = glm::max(high, p.position);
      std::vector<bool> met(photons.size() + 1);
      if (!grid.near(low, high,
                     [&](const Photon& p) { met[static_cast<size_t>(p.flux.x)] = true; })) {
        ++refused;
        continue;
      }
      for (const Photon& p : photons)
        for (const Photon& point : points) {
          const bool near = glm::distance(p.position, point.position) <= radius;
          ASSERT_TRUE(!near || met[static_cast<size_t>(p.flux.x)]) << "side " << side;
        }
    }
  EXPECT_GE(refused, 40) << "boxes as large as the room";
  EXPECT_LE(refused, 100) << "small boxes need no halving";
}

}  // namespace
}  // namespace ninefold
