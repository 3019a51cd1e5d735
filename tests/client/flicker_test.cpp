// What does not change does not flicker. Frames of a gesture share their random bits, so a task
// whose light set and rays are the same has the same bytes, the filter aside.
//
// There are two rooms with a lamp and a glass ball each, and a wall between them. A small box moves
// in the one, the camera looks at the other. A set without VPL or photon on the box or behind it is
// unchanged. So are all its rays in the camera's room, for they end there. Then the camera looks at
// the moving box. A pixel is unchanged if it shows neither box nor glass, and if no segment from
// its point x to a VPL of its set meets the box, before or after. Geometry tells that, if the
// shadow rays of a pixel do not depend on its neighbours' (no roulette) and end at x (no
// compensation). Whatever a gesture does to the lamp and the glass of the other room, no byte here
// changes.
#include <gtest/gtest.h>

#include <map>

#include "client/render_job.h"
#include "common/gi/radiosity/radiosity.h"
#include "common/scene/world.h"
#include "tests/gi/make_scene.h"

namespace ninefold {
namespace {

using testing::SceneBuilder;

constexpr int kSets = 9;
constexpr int kRightLamp = 4, kRightGlass = 5, kBox = 6;  // nodes
constexpr uint32_t kRightLampsMaterial = 3;

// side: of the room that the camera is in, -1 or 1. The box is in the other or the same, at x > 0.
std::shared_ptr<const Scene> twoRooms(float side) {
  SceneBuilder b;
  const int grey = b.material(testing::matte(Vec3(0.6f)));
  const int glass = b.material(testing::glass(1.5f));
  const int lamps[] = {b.material(testing::matte(Vec3(0), Vec3(10))),
                       b.material(testing::matte(Vec3(0), Vec3(10)))};
  b.box(grey, Vec3(-4, -1.5f, -1.5f), Vec3(4, 1.5f, 1.5f), true);
  b.box(grey, Vec3(-0.05f, -1.5f, -1.5f), Vec3(0.05f, 1.5f, 1.5f), false);
  for (const float x : {-2.0f, 2.0f}) {
    b.quad(lamps[x > 0], Vec3(x - 0.3f, 1.49f, -0.3f), Vec3(0.6f, 0, 0), Vec3(0, 0, 0.6f));
    b.sphere(glass, Vec3(x, -1, 0), 0.3f, 12);
  }
  b.box(grey, Vec3(3.0f, -1.4f, 0.8f), Vec3(3.15f, -1.25f, 0.95f), false);
  b.camera(Vec3(side * 0.6f, 0, 1.2f), Vec3(side * 2.4f, -0.6f, -0.3f), 1.2f);
  return std::make_shared<const Scene>(b.build());
}

Settings settings(const Scene& scene) {
  Settings s;
  s.width = 96, s.height = 72;
  s.camera = scene.cameras.front();
  return s;
}

FrameKey firstFrame(uint32_t randomization = 0) {
  FrameKey key;
  key.randomization = randomization, key.photonRadius = 0.08f;
  return key;
}

bool sameLight(const LightSet& a, const LightSet& b) {
  const auto sameVpl = [](const Vpl& x, const Vpl& y) {
    return x.position == y.position && x.normal == y.normal && x.power == y.power &&
           x.bound == y.bound && x.error == y.error;
  };
  const auto samePhoton = [](const Photon& x, const Photon& y) {
    return x.position == y.position && x.normal == y.normal && x.flux == y.flux;
  };
  bool same = std::ranges::equal(a.vpls, b.vpls, sameVpl);
  for (size_t kind = 0; kind < kPhotonKinds; ++kind)
    same = same &&
           std::ranges::equal(a.photons[kind].photons(), b.photons[kind].photons(), samePhoton);
  return same;
}

std::shared_ptr<const LightSet> lightSet(const Renderer& renderer, const FrameKey& key, int phase) {
  return std::dynamic_pointer_cast<const LightSet>(
      renderer.light(key, lightSetOfPhase(phase, key.rotation, kSets)));
}

// A frame by phase: its light set, and what its tasks send.
struct Frame {
  std::vector<std::shared_ptr<const LightSet>> light;
  std::vector<std::vector<Bytes>> sent;
};

Frame render(const std::shared_ptr<const TracedScene>& traced, const Settings& s,
             const FrameKey& key) {
  const Renderer renderer(traced->tracer, s);
  RenderJob job(traced, 1, s, {}, 1);
  Frame frame;
  for (int phase = 0; phase < kSets; ++phase) {
    frame.light.push_back(lightSet(renderer, key, phase));
    std::vector<Bytes>& tasks = frame.sent.emplace_back();
    const TileGrid grid(s.width, s.height, s.interleave);
    for (int tile = 0; tile < grid.tiles(); ++tile)
      tasks.push_back(job.run(key, {static_cast<uint32_t>(tile), static_cast<uint32_t>(phase), 0},
                              1, 1, 0, [] { return Time(); })
                          .result.encoded);
  }
  return frame;
}

Frame render(const std::shared_ptr<const TracedScene>& traced, const FrameKey& key) {
  return render(traced, settings(*traced->scene), key);
}

SceneEdit step(int i) {
  SceneEdit edit;
  edit.objects.push_back({kBox, DMat4(1)});
  edit.objects[0].motion[3] = DVec4(0.1 * i, 0, -0.15 * i, 1);
  return edit;
}

TEST(Flicker, UnchangedLightAndRaysGiveUnchangedBytes) {
  const auto scene = twoRooms(-1);
  auto traced = std::make_shared<const TracedScene>(scene, Isa::automatic);
  const Frame before = render(traced, firstFrame());
  int unchanged = 0, changed = 0;
  for (int i = 1; i <= 4; ++i) {
    traced = std::make_shared<const TracedScene>(*traced, step(i));
    const Frame after = render(traced, firstFrame());
    for (size_t phase = 0; phase < kSets; ++phase) {
      const bool same = sameLight(*before.light[phase], *after.light[phase]);
      ++(same ? unchanged : changed);
      if (same) {
        EXPECT_TRUE(before.sent[phase] == after.sent[phase]) << "step " << i << ", set " << phase;
      }
    }
  }
  EXPECT_GE(unchanged, 9);
  EXPECT_GE(changed, 3);
  // Without that, all sets and bytes are other ones.
  const Frame other = render(traced, firstFrame(1));
  for (size_t phase = 0; phase < kSets; ++phase) {
    EXPECT_FALSE(sameLight(*before.light[phase], *other.light[phase]));
    EXPECT_FALSE(before.sent[phase] == other.sent[phase]);
  }
}

bool meets(const Bounds& box, Vec3 from, Vec3 to) {
  float first = 0, last = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const float way = to[axis] - from[axis];
    float enter = (box.low[axis] - from[axis]) / way, leave = (box.high[axis] - from[axis]) / way;
    if (enter > leave) std::swap(enter, leave);
    first = std::max(first, enter), last = std::min(last, leave);
  }
  return first <= last;
}

// The box before or after, and a centimetre around it.
Bounds boxAt(const Scene& scene) {
  Bounds bounds;
  for (const Vec3& p : scene.meshes[kBox].positions)
    for (const float around : {-0.01f, 0.01f})
      bounds.add(worldPoint(scene.instances[kBox].toWorld, p) + Vec3(around));
  return bounds;
}

// All pixels of a frame, by phase: what they show, and their layers.
class Pixels {
 public:
  Pixels(const TracedScene& traced, const Settings& s, const FrameKey& key)
      : traced_(traced), settings_(s), grid_(s.width, s.height, s.interleave) {
    const Renderer renderer(traced.tracer, s);
    const auto scratch = renderer.makeScratch();
    for (int phase = 0; phase < kSets; ++phase) {
      light.push_back(lightSet(renderer, key, phase));
      for (int tile = 0; tile < grid_.tiles(); ++tile)
        renderer.render(Task{key, tile, phase, kObjectPlane | kDepthPlane}, *light.back(), *scratch,
                        results_[{phase, tile}]);
    }
  }
  // Of the first hit; nothing where there is none.
  std::optional<Vec3> point(int phase, int tile, int p) const {
    const TaskRect rect = grid_.rect(tile, phase);
    const TileResult& result = results_.at({phase, tile});
    const float depth = result.extras.depth[static_cast<size_t>(p)];
    if (!(depth > 0)) return std::nullopt;
    const auto px = static_cast<float>(grid_.pixelX(phase, rect.i0 + p % rect.width)) + 0.5f;
    const auto py = static_cast<float>(grid_.pixelY(phase, rect.j0 + p / rect.width)) + 0.5f;
    const CameraRays rays(settings_.camera, settings_.width, settings_.height);
    const Vec3 direction = rays.direction(px, py);
    return settings_.camera.eye + depth / glm::dot(direction, settings_.camera.forward) * direction;
  }
  bool showsPlainWall(int phase, int tile, int p) const {
    const uint32_t object = results_.at({phase, tile}).extras.object[static_cast<size_t>(p)];
    return object == 1 || object == 2;  // instance + 1
  }
  bool same(const Pixels& other, int phase, int tile, int p) const {
    const LayerPlanes& a = results_.at({phase, tile}).layers[kDiffuse];
    const LayerPlanes& b = other.results_.at({phase, tile}).layers[kDiffuse];
    const auto i = static_cast<size_t>(p);
    const auto rgb = [i](const RgbPlane& plane) {
      return Vec3(plane.r[i], plane.g[i], plane.b[i]);
    };
    return rgb(a.irradiance) == rgb(b.irradiance) && rgb(a.unfiltered) == rgb(b.unfiltered) &&
           rgb(a.reflectance) == rgb(b.reflectance) && rgb(a.normal) == rgb(b.normal) &&
           a.distance[i] == b.distance[i] && a.chain[i] == b.chain[i];
  }
  int count(int phase, int tile) const { return results_.at({phase, tile}).count(); }
  int tiles() const { return grid_.tiles(); }
  Bounds box() const { return boxAt(*traced_.scene); }

  std::vector<std::shared_ptr<const LightSet>> light;  // by phase

 private:
  const TracedScene& traced_;
  const Settings settings_;
  const TileGrid grid_;
  std::map<std::pair<int, int>, TileResult> results_;  // by phase and tile
};

TEST(Flicker, PixelsWhoseRaysMissTheMovedBoxAreUnchanged) {
  const auto scene = twoRooms(1);
  const TracedScene at0(scene, Isa::automatic), at1(at0, step(1));
  Settings s = settings(*scene);
  s.compensate = s.jitter = false, s.vplRoulette = 0;
  const Pixels before(at0, s, firstFrame()), after(at1, s, firstFrame());
  int unchanged = 0, others = 0, differ = 0;
  for (int phase = 0; phase < kSets; ++phase) {
    const LightSet& light = *before.light[static_cast<size_t>(phase)];
    const bool sameSet = sameLight(light, *after.light[static_cast<size_t>(phase)]);
    for (int tile = 0; tile < before.tiles(); ++tile)
      for (int p = 0; p < before.count(phase, tile); ++p) {
        const auto x = before.point(phase, tile, p);
        const bool plain =
            x && before.showsPlainWall(phase, tile, p) && after.showsPlainWall(phase, tile, p);
        const auto crossesBox = [&](const Vpl& vpl) {
          return meets(before.box(), *x, vpl.position) || meets(after.box(), *x, vpl.position);
        };
        if (sameSet && plain && std::ranges::none_of(light.vpls, crossesBox)) {
          ++unchanged;
          EXPECT_TRUE(before.same(after, phase, tile, p)) << phase << " " << tile << " " << p;
        } else {
          ++others;
          differ += !before.same(after, phase, tile, p);
        }
      }
  }
  EXPECT_GT(unchanged, 1000) << "of " << unchanged + others;
  EXPECT_GT(differ, 50);
}

TEST(Flicker, AGestureInAnotherRoomChangesNoByte) {
  const auto scene = twoRooms(-1);
  Settings s = settings(*scene);
  s.vplRoulette = 0, s.caustics = Caustics::direct;
  const auto begun = std::make_shared<const TracedScene>(scene, Isa::automatic);
  const Frame before = render(begun, s, firstFrame());
  const auto moved = [](int node) {
    SceneEdit edit;
    edit.objects.push_back({node, DMat4(1)});
    edit.objects[0].motion[3] = DVec4(0.4, 0.1, 0.3, 1);
    return edit;
  };
  const auto glowing = [&](float radiance) {
    SceneEdit edit;
    edit.materials.push_back(editOfMaterial(*scene, kRightLampsMaterial));
    edit.materials[0].emission = Vec3(radiance);
    return edit;
  };
  for (const SceneEdit& edit :
       {moved(kRightGlass), moved(kRightLamp), glowing(0), glowing(3), glowing(100)}) {
    const auto gesture = std::make_shared<const TracedScene>(*begun, edit, begun);
    EXPECT_TRUE(render(gesture, s, firstFrame()).sent == before.sent);
    // Shared out anew by power, they would all be others.
    if (edit.materials.empty()) continue;
    const auto atRest = std::make_shared<const TracedScene>(*begun, edit);
    EXPECT_FALSE(render(atRest, s, firstFrame()).sent == before.sent);
  }
}

}  // namespace
}  // namespace ninefold
