// The state of selective photons: who is in a group, how its hits travel, what a flux loses.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <set>

#include "common/gi/elements/packed_flux.h"
#include "common/gi/elements/scene_stamp.h"
#include "common/gi/selective/group_pages.h"
#include "common/sampling/sampler.h"
#include "tests/gi/make_scene.h"
#include "tests/gi/render.h"
#include "tests/seeds.h"

namespace ninefold {
namespace {

Settings poolOf(int photons, int groups, int ratio) {
  Settings s = testing::small(Method::selective);
  s.photonPool = photons, s.photonGroups = groups, s.pilotRatio = ratio;
  return s;
}

TEST(PhotonGroups, HaveEachPhotonOfThePoolOnce) {
  for (const auto& [photons, groups, ratio] :
       {std::tuple(147456, 288, 16), std::tuple(4608, 288, 16), std::tuple(80640, 10080, 8),
        std::tuple(4000, 10, 16)}) {
    const PhotonGroups all(poolOf(photons, groups, ratio));
    std::set<uint32_t> seen;
    for (uint32_t row = 0; row < all.rows(); ++row)
      for (uint32_t k = 0; k < all.photonsOf(row); ++k) {
        const uint32_t photon = all.photon(row, k);
        seen.insert(photon);
        EXPECT_LT(photon, all.photons());
        if (all.hasPilots(row))
          EXPECT_LT(photon, all.photons() / static_cast<uint32_t>(ratio));
        else
          EXPECT_EQ(all.likeGroup(photon - all.photons() / static_cast<uint32_t>(ratio)), row);
      }
    EXPECT_EQ(seen.size(), all.photons());
    EXPECT_LE(all.photonsOf(all.groups()), static_cast<uint32_t>(photons / groups));
  }
}

PhotonRow randomRow(uint64_t seed, size_t pilots, size_t hits) {
  PhotonRow row{hashWords(seed, 1), static_cast<uint32_t>(seed), 7, 3.5f, {}, {}};
  for (size_t i = 0; i < pilots; ++i)
    row.pilots.push_back(
        {static_cast<uint32_t>(hashWords(seed, 2, i)), 0.25f, static_cast<uint32_t>(i)});
  for (size_t i = 0; i < hits; ++i) {
    const uint64_t word = hashWords(seed, 3, i);
    row.hits.push_back({static_cast<uint32_t>(word), static_cast<uint16_t>(word >> 32),
                        static_cast<uint16_t>(word >> 48), static_cast<uint32_t>(word >> 7)});
  }
  return row;
}

TEST(GroupPages, GiveBackWhatWasWrittenHoweverLong) {
  const PhotonGroups groups(poolOf(147456, 288, 16));
  const GroupPages rows(groups);
  StatePages pages;
  EXPECT_FALSE(rows.read(pages, 5));
  for (const size_t hits : {size_t{1000}, rows.room(), size_t{0}, size_t{5448}, size_t{7000}}) {
    const PhotonRow row = randomRow(hits, 300, hits);
    pages.apply(rows.replace(pages, 5, row));
    ASSERT_TRUE(rows.read(pages, 5));
    EXPECT_EQ(*rows.read(pages, 5), row);
    EXPECT_EQ(rows.header(pages, 5)->stamp, row.stamp);
    EXPECT_EQ(rows.header(pages, 5)->version, 7u);
    EXPECT_FALSE(rows.read(pages, 4));
    EXPECT_FALSE(rows.read(pages, 6));
  }
}

TEST(GroupPages, ReadARowThatIsCutShortAsNothing) {
  const PhotonGroups groups(poolOf(4608, 288, 16));
  const GroupPages rows(groups);
  const StatePages none;
  PageDeltas deltas = rows.replace(none, 7, randomRow(1, 1, 40));
  auto& bytes = std::get<Records>(deltas[0].change);
  for (const size_t length : {bytes.size() - 1, size_t{30}, size_t{3}, size_t{0}}) {
    bytes.resize(length);
    StatePages pages;
    pages.apply(deltas);
    EXPECT_FALSE(rows.read(pages, 7)) << length;
  }
}

TEST(GroupPages, ReadImpossibleNumbersAsNothing) {
  const PhotonGroups groups(poolOf(4608, 288, 16));
  const GroupPages rows(groups);
  const auto isRead = [&](const std::function<void(PhotonRow&)>& spoil) {
    PhotonRow row = randomRow(1, 1, 40);
    spoil(row);
    StatePages pages;
    pages.apply(rows.replace(pages, 7, row));
    return rows.read(pages, 7).has_value();
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(isRead([](PhotonRow&) {}));
  for (const float x : {nan, -1.0f, 3e38f, std::numeric_limits<float>::infinity()}) {
    EXPECT_FALSE(isRead([&](PhotonRow& row) { row.lampFlux = x; }));
    EXPECT_FALSE(isRead([&](PhotonRow& row) { row.pilots[0].weight = x; }));
  }
}

TEST(GroupPages, KeepThePriorityOfEachGroup) {
  std::vector<int64_t> changes(10080, 0);
  changes[0] = 5, changes[8191] = 7, changes[8192] = 9, changes[10079] = -3;
  StatePages pages;
  PageDeltas deltas;
  GroupPages::addPriorities(changes, deltas);
  pages.apply(deltas);
  pages.apply(deltas);
  for (uint32_t g = 0; g < 10080; ++g)
    ASSERT_EQ(GroupPages::priority(pages, g), 2 * changes[g]) << g;
}

// Over all ways to round, the mean is the flux; no one is off by more than 1/128 of its largest.
TEST(PackedFlux, IsRightInTheMean) {
  for (const uint64_t seed : seedsFrom(1, 12)) {
    const Repeatable repeatable(seed);
    const float scale = std::ldexp(1.0f, static_cast<int>(hashWords(seed, 1) % 100) - 60);
    Flux flux;
    for (int c = 0; c < 3; ++c)
      flux[c] =
          scale * unitFloat(static_cast<uint32_t>(hashWords(seed, 2, static_cast<uint64_t>(c))));
    const float largest = std::max({flux.x, flux.y, flux.z});
    glm::dvec3 sum(0);
    constexpr int kWays = 100000;
    for (uint64_t i = 0; i < kWays; ++i) {
      const Flux packed = unpackFlux(packFlux(flux, hashWords(seed, 3, i)));
      for (int c = 0; c < 3; ++c) ASSERT_LE(std::abs(packed[c] - flux[c]), largest / 126);
      sum += glm::dvec3(packed);
    }
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(sum[c] / kWays / static_cast<double>(largest),
                  double{flux[c]} / static_cast<double>(largest), 1e-4);
  }
}

TEST(PackedFlux, KeepsNothingAndWhatIsExact) {
  EXPECT_EQ(packFlux(Flux(0), 77), 0u);
  EXPECT_EQ(unpackFlux(0), Flux(0));
  for (const Flux& flux : {Flux(1, 0.5f, 0), Flux(0x1p-100f), Flux(0x1p100f, 0, 0x1p95f)})
    EXPECT_EQ(unpackFlux(packFlux(flux, ~uint64_t{0} >> 4)), flux);
}

// Whatever an edit can change is felt; what it cannot change is not asked.
TEST(SceneStamp, TellsEveryEditApart) {
  testing::SceneBuilder b;
  b.box(b.material(testing::matte(Vec3(0.5f))), Vec3(-1), Vec3(1), true);
  b.quad(b.material(testing::matte(Vec3(0.2f), Vec3(3))), Vec3(-0.2f, 0.9f, -0.2f),
         Vec3(0.4f, 0, 0), Vec3(0, 0, 0.4f));
  PunctualLight lamp;
  b.light(lamp);
  const Scene scene = b.build();
  const auto stampOf = [](const Scene& s) {
    const Tracer tracer(s, Isa::automatic);
    return sceneStamp(Transport(tracer, testing::small(Method::selective)), {});
  };
  const uint64_t before = stampOf(scene);
  EXPECT_EQ(stampOf(scene), before);
  std::set<uint64_t> stamps{before};
  const auto add = [&](auto&& change) {
    Scene changed = scene;
    change(changed);
    stamps.insert(stampOf(changed));
  };
  add([](Scene& s) { s.instances[0].toWorld[3].x = 1e-4; });
  add([](Scene& s) { s.materials[0].baseColor.y = 0.51f; });
  add([](Scene& s) { s.materials[1].emission *= 0.5f; });
  add([](Scene& s) { s.materials[0].roughness = 0.4f; });
  add([](Scene& s) { s.materials[0].metallic = 0.4f; });
  add([](Scene& s) { s.materials[0].transmission = 0.4f; });
  add([](Scene& s) { s.materials[0].ior = 1.4f; });
  add([](Scene& s) { s.lights[0].intensity *= 2.0f; });
  add([](Scene& s) { s.lights[0].position.x = 0.3f; });
  add([](Scene& s) { s.lights[0].direction = Vec3(0, 1, 0); });
  add([](Scene& s) { s.lights[0].across = Vec3(0, 1, 0); });
  EXPECT_EQ(stamps.size(), 12u);
}

}  // namespace
}  // namespace ninefold
