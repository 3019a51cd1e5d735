// Position: a scene far from its file's origin gives the picture that it gives there. Files say
// where it is in double precision (OBJ: its numbers; glTF: the nodes' translations), the readers
// subtract the middle of the bounds, and everything after that works near 0.
//
// The room's coordinates are multiples of 2^-12 and the translations are such that every sum is
// exact: the pictures must be equal bit for bit, shadows, glass and thin panes included. 2^28 scene
// sizes is the limit that reader.h states: beyond it a double has fewer than 24 bits for the scene.
#include <fmt/format.h>

#include "common/scene/camera_choice.h"
#include "common/scene/reader.h"
#include "tests/gi/expect.h"
#include "tests/scene/gltf_bytes.h"
#include "tests/scene/temp_folder.h"

namespace ninefold {
namespace {

constexpr double kSize = 2;  // of the room [m]

struct Quad {
  const char* material;
  Vec3 origin, u, v;
};

// A room with a lamp, a thing that throws a shadow, a glass block and a pane.
std::vector<Quad> room() {
  std::vector<Quad> quads = {
      {"wall", {-1, -1, 1}, {2, 0, 0}, {0, 0, -2}},
      {"wall", {-1, -1, -1}, {2, 0, 0}, {0, 2, 0}},
      {"wall", {-1, -1, -1}, {0, 2, 0}, {0, 0, 2}},
      {"lamp", {-0.25f, 0.75f, -0.25f}, {0.5f, 0, 0}, {0, 0, 0.5f}},
      {"wall", {0.25f, -0.25f, -0.5f}, {0.5f, 0, 0}, {0, 0.125f, 0.5f}},
      {"pane", {-0.75f, -0.75f, 0.25f}, {0.75f, 0, 0}, {0, 1, 0}},
  };
  const Vec3 low(-0.5f, -0.75f, -0.5f), x(0.5f, 0, 0), y(0, 0.25f, 0), z(0, 0, 0.25f);
  for (const Quad& face : {Quad{"glass", low, x, z},
                           {"glass", low + y, z, x},
                           {"glass", low, y, x},
                           {"glass", low + z, x, y},
                           {"glass", low, z, y},
                           {"glass", low + x, y, z}})
    quads.push_back(face);
  return quads;
}

Scene fromObj(const TempFolder& folder, DVec3 at) {
  folder.write("a.mtl",
               "newmtl wall\nKd 0.5 0.5 0.5\nKs 0 0 0\nnewmtl lamp\nKd 0 0 0\nKs 0 0 0\nKe 9 9 9\n"
               "newmtl glass\nNi 1.5\nillum 4\nnewmtl pane\nKd 0.5 0.7 0.9\nKs 0 0 0\nd 0.5\n");
  std::string text = "mtllib a.mtl\n";
  for (const Quad& q : room()) {
    text += fmt::format("usemtl {}\n", q.material);
    for (const Vec3 p : {q.origin, q.origin + q.u, q.origin + q.u + q.v, q.origin + q.v}) {
      const DVec3 w = DVec3(p) + at;
      text += fmt::format("v {:.17g} {:.17g} {:.17g}\n", w.x, w.y, w.z);
    }
    text += "f -4 -3 -2 -1\n";
  }
  return readScene(folder.write("room.obj", text));
}

Scene fromGltf(const TempFolder& folder, DVec3 at) {
  const std::vector<Quad> quads = room();
  Bytes data;
  std::string views, accessors, meshes, nodes, children;
  const auto materialOf = [](const std::string& name) {
    return name == "wall" ? 0 : name == "lamp" ? 1 : name == "glass" ? 2 : 3;
  };
  for (size_t i = 0; i < quads.size(); ++i) {
    const Quad& q = quads[i];
    const Vec3 b = q.origin + q.u, c = b + q.v, d = q.origin + q.v;
    append<Vec3>(data, {q.origin, b, c, q.origin, c, d});
    const char* comma = i == 0 ? "" : ",";
    views += fmt::format(R"({}{{"buffer":0,"byteOffset":{},"byteLength":72}})", comma, 72 * i);
    accessors += fmt::format(
        R"({}{{"bufferView":{},"componentType":5126,"count":6,"type":"VEC3"}})", comma, i);
    meshes +=
        fmt::format(R"({}{{"primitives":[{{"attributes":{{"POSITION":{}}},"material":{}}}]}})",
                    comma, i, materialOf(q.material));
    nodes += fmt::format(R"(,{{"mesh":{}}})", i);
    children += fmt::format("{}{}", comma, i + 1);
  }
  const std::string json = fmt::format(
      R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],
"nodes":[{{"translation":[{:.17g},{:.17g},{:.17g}],"children":[{}]}}{}],"meshes":[{}],
"materials":[{{"pbrMetallicRoughness":{{"baseColorFactor":[0.5,0.5,0.5,1],"metallicFactor":0}}}},
{{"emissiveFactor":[1,1,1],"extensions":{{"KHR_materials_emissive_strength":{{"emissiveStrength":9}}}}}},
{{"pbrMetallicRoughness":{{"metallicFactor":0,"roughnessFactor":0}},
"extensions":{{"KHR_materials_transmission":{{"transmissionFactor":1}},"KHR_materials_volume":{{"thicknessFactor":1}}}}}},
{{"pbrMetallicRoughness":{{"metallicFactor":0,"roughnessFactor":0}},
"extensions":{{"KHR_materials_transmission":{{"transmissionFactor":1}}}}}}],
"accessors":[{}],"bufferViews":[{}],"buffers":[{{"byteLength":{}}}]}})",
      at.x, at.y, at.z, children, nodes, meshes, accessors, views, data.size());
  return readScene(folder.write("room.glb", glb(json, data)));
}

using Read = Scene (*)(const TempFolder&, DVec3);

// Seen from a place that is given in the file's coordinates, as on the command line.
testing::Rendered picture(Read read, DVec3 at, const testing::Estimator& e) {
  const TempFolder folder;
  Scene scene = read(folder, at);
  const DVec3 eye = at + DVec3(0.25, 0.25, 4), target = at;
  scene.cameras = {
      chooseCamera(scene, fmt::format("{:.17g},{:.17g},{:.17g}:{:.17g},{:.17g},{:.17g}:30", eye.x,
                                      eye.y, eye.z, target.x, target.y, target.z))};
  const Tracer tracer(scene, Isa::automatic);
  return testing::render(tracer, e.settings, 4);
}

void expectThePictureAtTheOrigin(Read read) {
  for (const auto& e : testing::estimators(24)) {
    const auto expected = picture(read, DVec3(0), e);
    ASSERT_GT(expected.grey(), 0.1);
    for (const double distance : {1e5, 0x1p28})
      EXPECT_EQ(picture(read, kSize * distance * DVec3(1, -0.5, 0.75), e).pixels, expected.pixels)
          << e.name << ", " << distance << " scene sizes away";
  }
}

TEST(Position, ObjFilesFarFromTheirOriginGiveTheSameBits) { expectThePictureAtTheOrigin(fromObj); }
TEST(Position, GltfNodesFarFromTheirOriginGiveTheSameBits) {
  expectThePictureAtTheOrigin(fromGltf);
}

}  // namespace
}  // namespace ninefold
