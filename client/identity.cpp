#include "client/identity.h"

#include "common/gi/renderer.h"

namespace ninefold::client {
namespace {

// Only a tracer knows which instruction set it really runs.
std::string isaThatRuns(Isa isa) {
  Scene triangle;
  triangle.materials.resize(1);
  triangle.meshes.resize(1);
  triangle.meshes[0].positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  triangle.meshes[0].triangles.resize(1);
  triangle.meshes[0].triangles[0] = {0, 1, 2};
  triangle.instances.resize(1);
  for (const Vec3 corner : triangle.meshes[0].positions) triangle.bounds.add(corner);
  return Tracer(triangle, isa).isaName();
}

}  // namespace

msg::Hello introduce(const Options& options) {
  msg::Hello hello;
  hello.name = options.name;
  hello.threads = static_cast<uint32_t>(options.threads);
  hello.isa = isaThatRuns(options.isa);
  hello.probeClass = probeClass(options.isa);
  return hello;
}

}  // namespace ninefold::client
