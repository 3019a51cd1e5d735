// scene_gltf.cpp: any bytes as a glTF file (text or binary) without other files beside it: an
// Error, or a Scene that passes validate and whose lights can be tabulated.
#include <string>

#include "common/base/error.h"
#include "common/scene/animation.h"
#include "common/scene/emitters.h"
#include "common/scene/gltf_scene.h"
#include "common/scene/needs.h"
#include "tests/fuzz/fuzz.h"
#include "tests/scene/compressed_mesh.h"

namespace {

using Input = std::vector<uint8_t>;

// A triangle with everything that the reader looks at: texture, camera, light, extensions, sparse
// data, animation.
const std::string kRich =
    R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1,2],"extensions":{"EXT_lights_image_based":{"light":0}}}],
"extensionsUsed":["KHR_lights_punctual","EXT_mesh_gpu_instancing","EXT_lights_ies"],
"extensions":{"EXT_lights_image_based":{"lights":[{"intensity":2,"rotation":[0,0.6,0,0.8],"specularImages":[[0,0,0,0,0,0]]}]},"EXT_lights_ies":{"lights":[{"uri":"data:,TILT=NONE%0A1 -1 1 2 1 1 2 0 0 0%0A1 1 0%0A0 90 0 9 3"},{"bufferView":0}]},"KHR_lights_punctual":{"lights":[{"type":"spot","intensity":3,"color":[1,1,1],"spot":{"innerConeAngle":0.1,"outerConeAngle":0.5}}]}},
"nodes":[{"mesh":0,"rotation":[0,0,0,1],"scale":[1,2,3],"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":0}}}},
{"camera":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,5,1]},{"camera":1,"extensions":{"KHR_lights_punctual":{"light":0},"EXT_lights_ies":{"light":0,"multiplier":2,"color":[1,0.5,0]}},"children":[3]},{"mesh":0}],
"animations":[{"channels":[{"sampler":0,"target":{"node":2,"path":"translation"}},{"sampler":0,"target":{"node":3,"path":"scale"}}],
"samplers":[{"input":1,"output":0,"interpolation":"LINEAR"}]}],
"cameras":[{"type":"perspective","perspective":{"yfov":0.7,"znear":0.1}},{"type":"orthographic","orthographic":{"xmag":1,"ymag":2,"znear":0,"zfar":9}}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":0,"TEXCOORD_0":2},"indices":1,"material":0,"mode":4},{"attributes":{"POSITION":0},"mode":5}]}],
"materials":[{"pbrMetallicRoughness":{"baseColorFactor":[1,1,1,1],"baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":{"offset":[0,1],"rotation":0.3}}},"roughnessFactor":0.2},
"emissiveFactor":[1,1,1],"emissiveTexture":{"index":0},"alphaMode":"MASK","extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":5},
"KHR_materials_transmission":{"transmissionFactor":0.5},"KHR_materials_volume":{"thicknessFactor":1},"KHR_materials_clearcoat":{"clearcoatFactor":0.5,"clearcoatTexture":{"index":0},"clearcoatRoughnessFactor":0.1},
"KHR_materials_sheen":{"sheenColorFactor":[1,0.5,0],"sheenRoughnessFactor":0.5,"sheenRoughnessTexture":{"index":0}},"KHR_materials_ior":{"ior":1.4}}}],
"textures":[{"source":0,"sampler":0}],"samplers":[{"wrapS":33071}],"images":[{"bufferView":2,"mimeType":"image/png"}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","sparse":{"count":1,"indices":{"bufferView":1,"componentType":5121},"values":{"bufferView":0}}},
{"bufferView":1,"componentType":5121,"count":3,"type":"SCALAR"},{"bufferView":0,"componentType":5123,"normalized":true,"count":3,"type":"VEC2"}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":4},{"buffer":0,"byteOffset":40,"byteLength":18}],
"buffers":[{"byteLength":60}]})";

void appendWord(Input& to, size_t word) {
  for (int shift = 0; shift < 32; shift += 8) to.push_back(static_cast<uint8_t>(word >> shift));
}

Input binary(std::string json, Input chunk) {
  while (json.size() % 4 != 0) json += ' ';
  while (chunk.size() % 4 != 0) chunk.push_back(0);
  Input file;
  for (const size_t word : {size_t{0x46546C67}, size_t{2}, 28 + json.size() + chunk.size(),
                            json.size(), size_t{0x4E4F534A}})
    appendWord(file, word);
  file.insert(file.end(), json.begin(), json.end());
  appendWord(file, chunk.size()), appendWord(file, 0x004E4942);
  file.insert(file.end(), chunk.begin(), chunk.end());
  return file;
}

// With the data of kRich.
Input binary(const std::string& json) {
  Input chunk(60, 0);
  chunk[14] = 0x80, chunk[15] = 0x3F, chunk[31] = 0x40;  // (0,0,0) (1,0,0) (0,2,0)
  chunk[37] = 1, chunk[38] = 2;                          // 0 1 2
  const uint8_t image[18] = {0, 0, 3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 1, 0, 8, 0x20};  // TGA
  std::copy(std::begin(image), std::end(image), chunk.begin() + 40);
  chunk[58] = 200;
  return binary(json, chunk);
}

Input packed(const ninefold::OneMeshFile& file) { return binary(file.json(), file.binary); }

// Meshes compressed in all ways.
std::vector<Input> compressed() {
  const ninefold::PlainMesh mesh = ninefold::wavyGrid(3);
  std::vector<Input> files = {packed(ninefold::meshoptFile(mesh))};
  for (const int speed : {0, 5, 10})
    files.push_back(packed(ninefold::dracoFile(ninefold::encodeDraco(mesh, speed), mesh.vertices(),
                                               mesh.indices.size())));
  return files;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

// The first mesh also with colours, morph targets that an animation weighs, and two skins.
std::string deformed(const std::string& json) {
  std::string text = replaced(json, R"({"mesh":0,)", R"({"mesh":0,"skin":0,"weights":[0.5],)");
  text = replaced(text, R"({"mesh":0}])", R"({"mesh":0,"skin":1}])");
  text = replaced(text, R"("TEXCOORD_0":2},)",
                  R"("TEXCOORD_0":2,"COLOR_0":4,"JOINTS_0":3,"WEIGHTS_0":4,"_OTHER":0},
                  "targets":[{"POSITION":0,"NORMAL":5},{"COLOR_0":4}],)");
  text =
      replaced(text, R"("animations":[{"channels":[)",
               R"("animations":[{"channels":[{"sampler":1,"target":{"node":0,"path":"weights"}},)");
  text = replaced(text, R"("interpolation":"LINEAR"}])",
                  R"("interpolation":"LINEAR"},{"input":1,"output":7}])");
  text = replaced(
      text, R"("bufferViews")",
      R"("skins":[{"joints":[2,3]},{"joints":[3],"inverseBindMatrices":6}],"bufferViews")");
  return replaced(text, R"("type":"VEC2"})", R"("type":"VEC2"},
{"bufferView":0,"componentType":5121,"count":3,"type":"VEC4"},
{"bufferView":0,"byteOffset":12,"componentType":5121,"normalized":true,"count":3,"type":"VEC4"},
{"componentType":5126,"count":3,"type":"VEC3"},{"componentType":5126,"count":1,"type":"MAT4"},
{"bufferView":0,"componentType":5126,"count":6,"type":"SCALAR"})");
}

}  // namespace

std::vector<Input> ninefoldFuzzSeeds() {
  const std::string view = R"("byteOffset":40,"byteLength":18)";
  const std::string good = replaced(kRich, view, R"("byteOffset":40,"byteLength":19)");
  const std::string text = replaced(
      good, R"({"byteLength":60})",
      R"({"byteLength":60,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAEAAAAAAAAECAAAAAwAAAAAAAAAAAAEAAQAIIMgA"})");
  std::vector<Input> seeds = compressed();
  seeds.insert(seeds.end(), {binary(good), binary(kRich), binary(deformed(good)),
                             Input(text.begin(), text.end())});
  return seeds;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  try {
    const ninefold::Scene scene =
        ninefold::finishScene(ninefold::readGltf({data, size}, ninefold::SceneFolder({}), {}));
    const ninefold::Emitters emitters(scene, scene.environment);
    ninefold::needsOf(scene, scene.environment);
    ninefold::animationAt(scene, ninefold::animationEnd(scene) / 3);
  } catch (const ninefold::Error&) {
  }
  return 0;
}
