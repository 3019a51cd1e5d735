#include "common/gi/elements/scene_stamp.h"

#include <bit>

#include "common/sampling/hash.h"

namespace ninefold {
namespace {

constexpr uint32_t kLooks =
    256;  // at which lamp a stream's number chooses, and where in its interval

class Stamp {
 public:
  void add(uint64_t word) { value_ = hashWords(value_, word); }
  void add(float x) { add(uint64_t{std::bit_cast<uint32_t>(x)}); }
  void add(Vec3 v) { add(v.x), add(v.y), add(v.z); }
  void add(const DMat4& m) {
    for (int column = 0; column < 4; ++column)
      for (int row = 0; row < 3; ++row) add(std::bit_cast<uint64_t>(m[column][row]));
  }
  uint64_t value() const { return value_; }

 private:
  uint64_t value_ = 0;
};

}  // namespace

uint64_t materialStamp(const Material& m) {
  Stamp stamp;
  stamp.add(m.baseColor), stamp.add(m.emission);
  stamp.add(m.metallic), stamp.add(m.roughness), stamp.add(m.transmission), stamp.add(m.ior);
  return stamp.value();
}

uint64_t lampsStamp(const Transport& t, const MinorLamps& minor) {
  Stamp stamp;
  for (uint32_t i = 0; i < t.emitters.size(); ++i) {
    const Emitter& e = t.emitters[i];
    stamp.add(hashWords(static_cast<uint64_t>(e.kind), e.instance, e.triangle, e.light));
    stamp.add(e.a), stamp.add(e.b), stamp.add(e.c);
    stamp.add(e.flux);
    // A lamp's share of the samples decides what its photons carry.
    stamp.add(t.streams.probability(i));
  }
  for (const PunctualLight& light : t.lights) {
    stamp.add(light.position), stamp.add(light.direction), stamp.add(light.across);
    stamp.add(light.intensity);
  }
  // Lamps that were on when a gesture began have their shares, too: looks at the whole of a stream.
  for (size_t s = 0; s < t.streams.count() && !t.emitters.empty(); ++s)
    for (uint32_t look = 0; look < kLooks; ++look) {
      const auto choice = t.streams.choose(s, (static_cast<float>(look) + 0.5f) / kLooks);
      stamp.add(choice ? hashWords(choice->index, std::bit_cast<uint32_t>(choice->remapped)) : 0);
    }
  stamp.add(t.emitters.environmentStrength());
  stamp.add(coverRadius(t.scene));
  for (const uint32_t lamp : minor.lamps()) stamp.add(uint64_t{lamp});
  return stamp.value();
}

uint64_t sceneStamp(const Transport& t, const MinorLamps& minor) {
  Stamp stamp;
  for (const Instance& instance : t.scene.instances) {
    stamp.add(instance.toWorld);
    stamp.add(t.scene.meshes[static_cast<size_t>(instance.mesh)].shape);
  }
  for (const Material& m : t.scene.materials) stamp.add(materialStamp(m));
  stamp.add(lampsStamp(t, minor));
  return stamp.value();
}

}  // namespace ninefold
