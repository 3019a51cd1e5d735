#include "proto/settings_wire.h"

#include "common/scene/methods.h"
#include "proto/messages.h"
#include "proto/text.h"

namespace ninefold {
namespace {

void toWire(Vec3 v, pb::Vec3& out) { out.set_x(v.x), out.set_y(v.y), out.set_z(v.z); }
Vec3 fromWire(const pb::Vec3& in) { return Vec3(in.x(), in.y(), in.z()); }

// Numbers that would not fit become -1, which no range allows.
int toInt(uint32_t value) { return value <= 0x7fffffff ? static_cast<int>(value) : -1; }

// Enums are checked before they are made: a value outside would already be wrong to hold.
template <typename Enum>
Enum toEnum(const char* field, uint32_t value, Enum last) {
  if (value > static_cast<uint32_t>(last))
    fail("{} is {}, must be 0 to {}", field, value, static_cast<uint32_t>(last));
  return static_cast<Enum>(value);
}

void toWire(const Camera& camera, pb::Camera& out) {
  out.set_name(printable(camera.name, kMaxText));
  toWire(camera.eye, *out.mutable_eye());
  toWire(camera.forward, *out.mutable_forward());
  toWire(camera.up, *out.mutable_up());
  out.set_vertical_fov(camera.verticalFov);
}

Camera fromWire(const pb::Camera& in) {
  Camera camera;
  if (printable(in.name(), kMaxText) != in.name())
    fail("camera name is longer than {} bytes or not printable UTF-8", kMaxText);
  camera.name = in.name();
  camera.eye = fromWire(in.eye());
  camera.forward = fromWire(in.forward());
  camera.up = fromWire(in.up());
  camera.verticalFov = in.vertical_fov();
  return camera;
}

}  // namespace

void toWire(const Settings& s, pb::Settings& out) {
  out.set_method(static_cast<uint32_t>(s.method));
  out.set_width(static_cast<uint32_t>(s.width));
  out.set_height(static_cast<uint32_t>(s.height));
  toWire(s.camera, *out.mutable_camera());
  out.set_interleave_n(static_cast<uint32_t>(s.interleave.n));
  out.set_interleave_m(static_cast<uint32_t>(s.interleave.m));
  out.set_direct_vpls(static_cast<uint32_t>(s.directVpls));
  out.set_indirect_vpls(static_cast<uint32_t>(s.indirectVpls));
  out.set_photons(static_cast<uint32_t>(s.photons));
  out.set_path_length(static_cast<uint32_t>(s.pathLength));
  out.set_specular_depth(static_cast<uint32_t>(s.specularDepth));
  out.set_bound(s.bound);
  out.set_photon_radius(s.photonRadius);
  out.set_vpl_roulette(s.vplRoulette);
  out.set_caustics(static_cast<uint32_t>(s.caustics));
  toWire(s.environment, *out.mutable_environment());
  out.set_seed(s.seed);
  out.set_randomization(static_cast<uint32_t>(s.randomization));
  out.set_jitter(s.jitter);
  out.set_compensate(s.compensate);
}

Settings fromWire(const pb::Settings& in) {
  Settings s;
  s.method = toEnum("method", in.method(), allMethods().back().method);
  s.width = toInt(in.width());
  s.height = toInt(in.height());
  s.camera = fromWire(in.camera());
  s.interleave = {toInt(in.interleave_n()), toInt(in.interleave_m())};
  s.directVpls = toInt(in.direct_vpls());
  s.indirectVpls = toInt(in.indirect_vpls());
  s.photons = toInt(in.photons());
  s.pathLength = toInt(in.path_length());
  s.specularDepth = toInt(in.specular_depth());
  s.bound = in.bound();
  s.photonRadius = in.photon_radius();
  s.vplRoulette = in.vpl_roulette();
  s.caustics = toEnum("caustics", in.caustics(), Caustics::all);
  s.environment = fromWire(in.environment());
  s.seed = in.seed();
  s.randomization = toEnum("randomization", in.randomization(), Randomization::random);
  s.jitter = in.jitter();
  s.compensate = in.compensate();
  checkRanges(s);
  return s;
}

void toWire(const FrameKey& frame, pb::FrameKey& out) {
  out.set_frame(frame.frame);
  out.set_randomization(frame.randomization);
  out.set_rotation(frame.rotation);
  out.set_photon_radius(frame.photonRadius);
}

FrameKey fromWire(const pb::FrameKey& in) {
  const FrameKey frame{in.frame(), in.randomization(), in.rotation(), in.photon_radius()};
  checkRanges(frame);
  return frame;
}

}  // namespace ninefold
