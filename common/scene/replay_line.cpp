#include "common/scene/replay_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "common/scene/camera_choice.h"

namespace ninefold {
namespace {

constexpr std::array kMethods{"instant-radiosity", "path-trace"};
constexpr std::array kCaustics{"off", "direct", "all"};

template <typename Names, typename Value>
const char* nameOf(const Names& names, Value value) {
  return names[static_cast<size_t>(value)];
}

const char* nameOf(Randomization r) {
  return r == Randomization::owen ? "owen" : r == Randomization::exclusiveOr ? "xor" : "random";
}

// By its number, if it is one of the scene's: that is exact.
std::string cameraOf(const Scene& scene, const Camera& camera) {
  const auto found = std::ranges::find(scene.cameras, camera);
  if (found == scene.cameras.end()) return specOf(scene, camera);
  return std::to_string(found - scene.cameras.begin());
}

}  // namespace

std::string replayLine(const Scene& scene, const Settings& s, const FrameKey& frame, int tile,
                       int phase) {
  std::string line = fmt::format(
      "ninefold-replay-task SCENE --frame {}:{}:{}:{:.9g} --tile {} --phase {} --size {}x{} "
      "--camera {} --seed {} --method {} --interleave {}x{} --path-length {} --specular-depth {} "
      "--environment {:.9g},{:.9g},{:.9g} --randomization {}{}",
      frame.frame, frame.randomization, frame.rotation, frame.photonRadius, tile, phase, s.width,
      s.height, cameraOf(scene, s.camera), s.seed, nameOf(kMethods, s.method), s.interleave.n,
      s.interleave.m, s.pathLength, s.specularDepth, s.environment.x, s.environment.y,
      s.environment.z, nameOf(s.randomization), s.compensate ? "" : " --preset paper");
  if (s.method == Method::pathTrace) return line;
  return line + fmt::format(
                    " --direct-vpls {} --indirect-vpls {} --photons {} --bound {:.9g} "
                    "--vpl-roulette {:.9g} --photon-radius {:.9g} --caustics {}",
                    s.directVpls, s.indirectVpls, s.photons, s.bound, s.vplRoulette, s.photonRadius,
                    nameOf(kCaustics, s.caustics));
}

}  // namespace ninefold
