#include "common/scene/replay_line.h"

#include <fmt/format.h>

#include <array>

#include "common/scene/camera_choice.h"
#include "common/scene/methods.h"

namespace ninefold {
namespace {

constexpr std::array kCaustics{"off", "direct", "all"};

template <typename Names, typename Value>
const char* nameOf(const Names& names, Value value) {
  return names[static_cast<size_t>(value)];
}

const char* nameOf(Randomization r) {
  return r == Randomization::owen ? "owen" : r == Randomization::exclusiveOr ? "xor" : "random";
}

}  // namespace

std::string replayLine(const Scene& scene, const Settings& s, uint32_t frame) {
  const MethodFacts& facts = factsOf(s.method);
  std::string line = fmt::format(
      "ninefold-master SCENE --local-clients 1 --output again.exr --frames {} --size {}x{} "
      "--camera {} --seed {} --method {} --interleave {}x{} --path-length {} --specular-depth {} "
      "--environment {:.9g},{:.9g},{:.9g} --randomization {}",
      uint64_t{frame} + 1, s.width, s.height, specOf(scene, s.camera), s.seed, facts.name,
      s.interleave.n, s.interleave.m, s.pathLength, s.specularDepth, s.environment.x,
      s.environment.y, s.environment.z, nameOf(s.randomization));
  if (!facts.has(kVpls | kCausticPhotons)) return line;
  return line + fmt::format(
                    " --direct-vpls {} --indirect-vpls {} --photons {} --bound {:.9g} "
                    "--vpl-roulette {:.9g} --photon-radius {:.9g} --caustics {}",
                    s.directVpls, s.indirectVpls, s.photons, s.bound, s.vplRoulette, s.photonRadius,
                    nameOf(kCaustics, s.caustics));
}

}  // namespace ninefold
