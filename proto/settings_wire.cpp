#include "proto/settings_wire.h"

#include <cmath>
#include <map>

#include "common/scene/settings_check.h"
#include "common/scene/settings_table.h"
#include "proto/messages.h"
#include "proto/text.h"

namespace ninefold {
namespace {

void toWire(Vec3 v, pb::Vec3& out) { out.set_x(v.x), out.set_y(v.y), out.set_z(v.z); }
Vec3 fromWire(const pb::Vec3& in) { return Vec3(in.x(), in.y(), in.z()); }

void toWire(const Camera& camera, pb::Camera& out) {
  out.set_name(printable(camera.name, kMaxText));
  toWire(camera.eye, *out.mutable_eye());
  toWire(camera.forward, *out.mutable_forward());
  toWire(camera.up, *out.mutable_up());
  out.set_vertical_fov(camera.verticalFov);
  out.set_orthographic_height(camera.orthographicHeight);
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
  camera.orthographicHeight = in.orthographic_height();
  return camera;
}

// Both numbers and the camera: one overload for each type of a row.
void put(uint64_t value, pb::Setting& out) { out.add_whole(value); }
void put(int value, pb::Setting& out) { out.add_whole(static_cast<uint64_t>(int64_t{value})); }
void put(bool value, pb::Setting& out) { out.add_whole(value ? 1 : 0); }
void put(float value, pb::Setting& out) { out.add_real(value); }
void put(Interleave value, pb::Setting& out) { put(value.n, out), put(value.m, out); }
void put(Radiance value, pb::Setting& out) {
  for (int i = 0; i < 3; ++i) out.add_real(value[i]);
}
void put(const Camera& value, pb::Setting& out) { toWire(value, *out.mutable_camera()); }
template <typename Enum>
requires std::is_enum_v<Enum>
void put(Enum value, pb::Setting& out) { out.add_whole(static_cast<uint64_t>(value)); }

void expect(const pb::Setting& in, const char* name, int wholes, int reals, int cameras = 0) {
  const int held = in.has_camera() ? 1 : 0;
  if (in.whole_size() != wholes || in.real_size() != reals || held != cameras)
    fail("{} has {} whole numbers, {} real ones and {} cameras, must have {}, {} and {}", name,
         in.whole_size(), in.real_size(), held, wholes, reals, cameras);
}

// Numbers that would not fit become -1, which no range allows.
int toInt(uint64_t value) { return value <= 0x7fffffff ? static_cast<int>(value) : -1; }

void take(const pb::Setting& in, const Setting<uint64_t>& row, uint64_t& to) {
  expect(in, row.name, 1, 0);
  to = in.whole(0);
}

void take(const pb::Setting& in, const Setting<int>& row, int& to) {
  expect(in, row.name, 1, 0);
  to = toInt(in.whole(0));
  checkRange(row, to);
}

void take(const pb::Setting& in, const Setting<bool>& row, bool& to) {
  expect(in, row.name, 1, 0);
  if (in.whole(0) > 1) fail("{} is {}, must be 0 or 1", row.name, in.whole(0));
  to = in.whole(0) == 1;
}

void take(const pb::Setting& in, const Setting<float>& row, float& to) {
  expect(in, row.name, 0, 1);
  to = in.real(0);
  checkRange(row, to);
}

void take(const pb::Setting& in, const Setting<Interleave>& row, Interleave& to) {
  expect(in, row.name, 2, 0);
  to = {toInt(in.whole(0)), toInt(in.whole(1))};
  checkRange(row, to);
}

void take(const pb::Setting& in, const Setting<Radiance>& row, Radiance& to) {
  expect(in, row.name, 0, 3);
  to = Radiance(in.real(0), in.real(1), in.real(2));
  checkRange(row, to);
}

void take(const pb::Setting& in, const Setting<Camera>& row, Camera& to) {
  expect(in, row.name, 0, 0, 1);
  to = fromWire(in.camera());
  checkRange(row, to);
}

// Checked before it is made: a value outside would already be wrong to hold.
template <typename Enum>
void take(const pb::Setting& in, const Setting<Enum>& row, Enum& to) {
  expect(in, row.name, 1, 0);
  checkRange(row, in.whole(0));
  to = static_cast<Enum>(in.whole(0));
}

using ByName = std::map<std::string, const pb::Setting*>;

ByName byName(const pb::Settings& in) {
  ByName given;
  for (const pb::Setting& each : in.setting())
    if (!given.emplace(each.name(), &each).second)
      fail("{} is there twice", printable(each.name(), kMaxText));
  return given;
}

}  // namespace

void toWire(const Settings& settings, pb::Settings& out) {
  forEachSetting([&](const auto& row) {
    pb::Setting& setting = *out.add_setting();
    setting.set_name(row.name);
    put(settings.*row.member, setting);
  });
}

Settings fromWire(const pb::Settings& in) {
  ByName given = byName(in);
  Settings settings;
  forEachSetting([&](const auto& row) {
    const auto found = given.extract(row.name);
    if (found.empty()) fail("{} is missing", row.name);
    take(*found.mapped(), row, settings.*row.member);
  });
  if (!given.empty())
    fail("{} is no setting that this release has", printable(given.begin()->first, kMaxText));
  checkTogether(settings);
  return settings;
}

void toWire(const FrameKey& frame, pb::FrameKey& out) {
  out.set_frame(frame.frame);
  out.set_randomization(frame.randomization);
  out.set_rotation(frame.rotation);
  out.set_photon_radius(frame.photonRadius);
  for (const Camera& camera : frame.lightCameras) toWire(camera, *out.add_light_cameras());
  out.set_state(frame.state);
}

FrameKey fromWire(const pb::FrameKey& in) {
  FrameKey frame{in.frame(), in.randomization(), in.rotation(), in.photon_radius()};
  frame.state = in.state();
  if (!(frame.photonRadius >= 0) || !std::isfinite(frame.photonRadius))
    fail("photon radius of frame {} is {}, must be 0 or more", frame.frame, frame.photonRadius);
  const auto cameras = static_cast<size_t>(in.light_cameras_size());
  if (cameras > kMostLightCameras)
    fail("frame {} has {} light cameras, must be 0 to {}", frame.frame, cameras, kMostLightCameras);
  for (const pb::Camera& camera : in.light_cameras()) {
    frame.lightCameras.push_back(fromWire(camera));
    checkRange(settingOf(&Settings::camera), frame.lightCameras.back());
  }
  return frame;
}

void toWire(const StepKey& step, pb::StepKey& out) {
  out.set_number(step.number);
  out.set_from(step.from);
  out.set_to(step.to);
  out.set_first_unit(step.firstUnit);
  out.set_randomization(step.randomization);
  out.set_units(step.units);
}

StepKey fromWire(const pb::StepKey& in) {
  const StepKey step{in.number(),     in.from(),          in.to(),
                     in.first_unit(), in.randomization(), in.units()};
  if (step.to <= step.from)
    fail("step {} leads from version {} to {}, must lead to a later one", step.number, step.from,
         step.to);
  return step;
}

}  // namespace ninefold
