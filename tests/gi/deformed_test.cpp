// A deformed mesh: every method shows what it shows of a scene that was read so, to the last bit.
#include <bit>

#include "common/gi/whole_state.h"
#include "common/sampling/hash.h"
#include "tests/gi/expect.h"
#include "tests/gi/field_room.h"

namespace ninefold {
namespace {

using testing::kFirstLamp;

// A set of a frame at rest, with the method's state.
uint64_t pictureOf(const Tracer& tracer, const Settings& settings) {
  const Renderer renderer(tracer, settings);
  const auto state = wholeState(renderer, settings, 0);
  const auto light = renderer.light({0, 0, 0, 0.05f}, 0, state.get());
  const auto scratch = renderer.makeScratch();
  TileResult tile;
  renderer.render(Task{{0, 0, 0, 0.05f}, 0, 0, 0}, *light, *scratch, tile);
  uint64_t hash = 0;
  for (const LayerPlanes& layer : tile.layers)
    for (const auto* plane : {&layer.irradiance.r, &layer.irradiance.g, &layer.unfiltered.r})
      for (const float x : *plane) hash = hashWords(hash, std::bit_cast<uint32_t>(x));
  return hash;
}

// The edited tracer has the deformed mesh beside the rest; the other one builds all at once.
TEST(Deformed, ASceneGivesTheBytesOfOneThatWasReadSo) {
  const Scene& read = testing::fieldRoom();
  const Tracer tracer(read, Isa::automatic);
  SceneEdit edit = testing::twistedBox();
  merge(edit, testing::bent(kFirstLamp));
  checkEdit(read, edit);
  const Scene deformed = edited(read, edit);
  const Tracer tracerAfter(tracer, deformed, movedInstances(read, edit));
  Scene readSo = deformed;
  for (size_t i = 0; i < readSo.meshes.size(); ++i) readSo.meshes[i].shape = 0;
  const Tracer whole(readSo, Isa::automatic);
  for (testing::Estimator e : testing::estimators()) {
    e.settings.camera = read.cameras.front();
    const uint64_t picture = pictureOf(tracerAfter, e.settings);
    EXPECT_EQ(picture, pictureOf(whole, e.settings)) << e.name;
    EXPECT_NE(picture, pictureOf(tracer, e.settings)) << e.name;
  }
}

// A lamp that is folded to nothing shines no more, and all goes on.
TEST(Deformed, ALampWithoutAreaIsDark) {
  const Scene& read = testing::fieldRoom();
  const auto mesh = static_cast<uint32_t>(read.instances[kFirstLamp].mesh);
  SceneEdit edit;
  edit.shapes = shapeEdits(mesh, std::vector<Vec3>(4, read.meshes[mesh].positions[0]), {});
  checkEdit(read, edit);
  const Scene folded = edited(read, edit);
  const Tracer before(read, Isa::automatic), tracer(before, folded, movedInstances(read, edit));
  for (testing::Estimator e : testing::estimators()) {
    e.settings.camera = read.cameras.front();
    const auto lit = testing::render(before, e.settings, 1),
               dim = testing::render(tracer, e.settings, 1);
    EXPECT_LT(dim.grey(), 0.8 * lit.grey()) << e.name;
    EXPECT_GT(dim.grey(), 0.2 * lit.grey()) << e.name;
  }
}

}  // namespace
}  // namespace ninefold
