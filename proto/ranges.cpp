#include <cmath>

#include "common/scene/methods.h"
#include "proto/messages.h"

namespace ninefold {
namespace {

void inRange(const char* field, int64_t value, int64_t low, int64_t high) {
  if (value < low || value > high) fail("{} is {}, must be {} to {}", field, value, low, high);
}

void positive(const char* field, float value) {
  if (!(value > 0) || !std::isfinite(value)) fail("{} is {}, must be above 0", field, value);
}

void finite(const char* field, Vec3 v) {
  if (!isFinite(v)) fail("{} is not finite", field);
}

void checkCamera(const Camera& camera) {
  finite("camera eye", camera.eye);
  finite("camera forward", camera.forward);
  finite("camera up", camera.up);
  if (std::abs(glm::length(camera.forward) - 1) > 1e-3f)
    fail("camera forward is not a unit vector");
  const float upLength = glm::length(camera.up);
  if (!(glm::length(glm::cross(camera.forward, camera.up)) > 1e-6f * upLength))
    fail("camera up is parallel to forward, or zero");
  if (!(camera.verticalFov > 0 && camera.verticalFov < kPi))
    fail("camera field of view is {}, must be between 0 and pi", camera.verticalFov);
}

}  // namespace

void checkRanges(const Settings& s) {
  inRange("method", static_cast<int>(s.method), 0, static_cast<int>(allMethods().back().method));
  inRange("width", s.width, 1, 16384);
  inRange("height", s.height, 1, 16384);
  checkCamera(s.camera);
  inRange("interleave columns", s.interleave.n, 1, 16);
  inRange("interleave rows", s.interleave.m, 1, 16);
  inRange("direct-vpls", s.directVpls, 0, 65536);
  inRange("indirect-vpls", s.indirectVpls, 0, 65536);
  inRange("photons", s.photons, 0, 16777216);
  inRange("path-length", s.pathLength, 0, 1 << 20);
  inRange("specular-depth", s.specularDepth, 1, 1024);
  positive("bound", s.bound);
  positive("photon-radius", s.photonRadius);
  if (!(s.vplRoulette >= 0 && s.vplRoulette <= kMaxVplRoulette))
    fail("vpl-roulette is {}, must be 0 to {}", s.vplRoulette, kMaxVplRoulette);
  inRange("caustics", static_cast<int>(s.caustics), 0, static_cast<int>(Caustics::all));
  finite("environment", s.environment);
  if (s.environment.x < 0 || s.environment.y < 0 || s.environment.z < 0)
    fail("environment is negative");
  inRange("randomization", static_cast<int>(s.randomization), 0,
          static_cast<int>(Randomization::random));
}

void checkRanges(const FrameKey& frame) {
  if (!(frame.photonRadius >= 0) || !std::isfinite(frame.photonRadius))
    fail("photon radius of frame {} is {}, must be 0 or more", frame.frame, frame.photonRadius);
}

}  // namespace ninefold
