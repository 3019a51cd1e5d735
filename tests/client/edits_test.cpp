// A client that followed a session of random edits and one that came late give the same bytes, and so does
// one on the scene that was edited before it was traced, where rounding leaves no choice.
#include <gtest/gtest.h>

#include <random>

#include "client/render_job.h"
#include "common/scene/reader.h"

namespace ninefold {
namespace {

constexpr int kEdits = 1000;

class RandomEdits {
 public:
  RandomEdits(const Scene& scene, uint32_t seed) : scene_(scene), random_(seed) {
    for (const Instance& instance : scene.instances)
      if (nodes_.empty() || nodes_.back() != instance.node) nodes_.push_back(instance.node);
  }

  SceneEdit next() {
    SceneEdit edit;
    const int things = 1 + static_cast<int>(random_() % 2);
    for (int i = 0; i < things; ++i) {
      const auto dice = random_() % 10;
      if (dice < 6) edit.objects.push_back(motion());
      if (dice >= 6) edit.materials.push_back(material());
    }
    SceneEdit once;
    merge(once, edit);
    return once;
  }

 private:
  double real(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  ObjectEdit motion() {
    ObjectEdit edit;
    edit.node = nodes_[random_() % nodes_.size()];
    const double angle = real(-0.3, 0.3), c = std::cos(angle), s = std::sin(angle);
    edit.motion = DMat4(DVec4(c, 0, -s, 0), DVec4(0, 1, 0, 0), DVec4(s, 0, c, 0),
                        DVec4(real(-0.3, 0.3), real(0, 0.2), real(-0.3, 0.3), 1));
    if (random_() % 8 == 0) edit.motion = DMat4(1);  // back where it was
    return edit;
  }
  MaterialEdit material() {
    const auto index = static_cast<uint32_t>(random_() % scene_.materials.size());
    MaterialEdit edit = editOfMaterial(scene_, index);
    const auto unit = [this] { return static_cast<float>(real(0, 1)); };
    edit.baseColor = Vec3(unit(), unit(), unit());
    edit.roughness = unit(), edit.metallic = random_() % 4 == 0 ? 1.0f : 0.0f;
    edit.transmission = random_() % 4 == 0 ? 1.0f : 0.0f;
    edit.ior = 1 + unit();
    edit.emission *= 2 * unit();
    return edit;
  }

  const Scene& scene_;
  std::mt19937 random_;
  std::vector<int> nodes_;
};

Settings smallPicture(const Scene& scene) {
  Settings s;
  s.width = 96, s.height = 72;
  s.camera = scene.cameras.front();
  return s;
}

// All tasks of a frame, as they would travel.
std::vector<Bytes> render(const std::shared_ptr<const TracedScene>& scene) {
  RenderJob job(scene, 1, smallPicture(*scene->scene), {}, 1);
  FrameKey key;
  key.photonRadius = 0.05f;
  std::vector<Bytes> tiles;
  for (uint32_t phase = 0; phase < 9; ++phase)
    tiles.push_back(job.run(key, {0, phase, 0}, 1, 1, 0, [] { return Time(); }).result.encoded);
  return tiles;
}

TEST(Edits, AThousandFollowedOrTakenAtOnceGiveTheSameBytes) {
  const auto read = std::make_shared<const Scene>(readScene(NINEFOLD_SCENES "/table_room.glb"));
  const auto asRead = std::make_shared<const TracedScene>(read, Isa::automatic);
  RandomEdits random(*read, 7);
  SceneEdit all;
  std::shared_ptr<const TracedScene> followed = asRead;
  int compared = 0;
  for (int i = 1; i <= kEdits; ++i) {
    merge(all, random.next());
    ASSERT_NO_THROW(checkEdit(*read, all));
    followed = std::make_shared<const TracedScene>(*followed, all);
    if (i % 250 != 0 && i != 1) continue;
    const auto fresh = std::make_shared<const TracedScene>(
        TracedScene(std::make_shared<const Scene>(*read), Isa::automatic), all);
    EXPECT_EQ(render(followed), render(fresh)) << "after " << i << " edits";
    ++compared;
  }
  EXPECT_EQ(compared, 5);
  EXPECT_NE(render(followed), render(asRead));
}

// The other order of building: edited first, traced in one hierarchy.
TEST(Edits, PartsOfTheirOwnSeeWhatOneHierarchySees) {
  const auto read = std::make_shared<const Scene>(readScene(NINEFOLD_SCENES "/table_room.glb"));
  const TracedScene asRead(read, Isa::automatic);
  RandomEdits random(*read, 11);
  SceneEdit all;
  for (int i = 0; i < 20; ++i) merge(all, random.next());
  const TracedScene apart(asRead, all);
  const Tracer whole(*apart.scene, Isa::automatic);
  std::mt19937 rays(3);
  std::uniform_real_distribution<float> unit(-1, 1);
  int hits = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 origin = 0.5f * Vec3(unit(rays), unit(rays), unit(rays));
    const Vec3 direction = glm::normalize(Vec3(unit(rays), unit(rays), unit(rays)));
    const Hit a = apart.tracer.closest(origin, direction, 100);
    const Hit b = whole.closest(origin, direction, 100);
    ASSERT_EQ(bool(a), bool(b));
    EXPECT_EQ(apart.tracer.occluded(origin, direction, 100), bool(b));
    if (!a) continue;
    ++hits;
    EXPECT_EQ(a.t, b.t);
    if (a.instance == b.instance && a.triangle == b.triangle) {
      EXPECT_EQ(apart.tracer.surface(a).position, whole.surface(b).position);
    }
  }
  EXPECT_GT(hits, 10000);
}

}  // namespace
}  // namespace ninefold
