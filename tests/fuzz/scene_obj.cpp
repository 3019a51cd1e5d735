// scene_obj.cpp: any bytes as an OBJ file, and, behind a line "===", as its material library,
// beside a texture t.png: an Error, or a Scene that passes validate.
#include <string>
#include <string_view>

#include "common/base/error.h"
#include "common/scene/obj_reader.h"
#include "tests/fuzz/fuzz.h"
#include "tests/scene/png_bytes.h"
#include "tests/scene/temp_folder.h"

namespace {

constexpr std::string_view kLibrary = "===\n";

const ninefold::TempFolder& folderWithTexture() {
  static const ninefold::TempFolder folder;  // one for the process: making folders is slow
  static const auto texture = folder.write("t.png", ninefold::png(2, 1, 3, {9, 8, 7, 0, 128, 255}));
  return folder;
}

}  // namespace

std::vector<std::vector<uint8_t>> ninefoldFuzzSeeds() {
  const std::string_view text =
      "mtllib a.mtl\no thing\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.5\nv .5 2e-1 +3\n"
      "vt 0 0\nvt 1 0.5\nvn 0 0 1\ng one two\nusemtl m\nf 1/1/1 2/2/1 3//1 -2\ns 1\n"
      "usemtl glass\nf 1 2 3 4 5\nf -1 -2/1 -3\nl 1 2\np 1\n"
      "===\nnewmtl m\nKd 0.5 0.5 0.5\nKs .1 .1 .1\nNs 100\nKe 1 2 3\nd 0.5\nillum 2\n"
      "newmtl glass\nNi 1.5\nTf 1 0.5 1\nillum 7\nmap_bump -bm 2 -o 1 2 3 x.png\n";
  const std::string_view mapped =
      "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl m\nf 1 2 3\n"
      "===\nnewmtl m\nmap_Kd -s 1 2 3 -clamp on ../x.png\nmap_d x.png\nTr 1\n";
  const std::string_view written =
      "\xEF\xBB\xBFmtllib \"a b.mtl\" a.mtl # two\nv 0 0 \\\n0 1 0 0\nv 1 0 0 0.5\nv 1 1 0 1 1 0 "
      ".5\n"
      "o \"a thing\"\ts\nusemtl Hard  White # it\nf 1 2 3 # face\nvp 1\ncstype bezier\n"
      "===\n\xEF\xBB\xBFnewmtl Hard White\nkd 0.5\nPr .5\nPm 1\nPs 1\nd -halo .5\nTr .25\n"
      "map_kd -s 2 2 -mm .5 .25 t.png\nmap_d \"C:\\x\\t.png\" -o 1 -imfchan m\n"
      "map_Pr -s 2 1 t.png\nmap_Pm -mm 1 -1 t.png\nmap_Bump -bm -2 -clamp on t.png\n";
  const std::string_view shiny =
      "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl m\nf 1 2 3\n"
      "===\nnewmtl m\nKd 0 0 0\nKs .9 .8 .7\nNs 1000\nillum 3\nKa .5\nTf 1 .5 1\nNi 1.5\n"
      "map_Ke -mm 0 10 t.png\nmap_Ks t.png\nnorm -bm .5 t.png\nrefl -type sphere t.png\n";
  std::vector<std::vector<uint8_t>> seeds;
  for (const std::string_view seed : {text, mapped, written, shiny})
    seeds.emplace_back(seed.begin(), seed.end());
  return seeds;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const ninefold::TempFolder& folder = folderWithTexture();
  std::string_view text(reinterpret_cast<const char*>(data), size);
  const size_t cut = text.find(kLibrary);
  const std::string_view library =
      cut == std::string_view::npos ? std::string_view() : text.substr(cut + kLibrary.size());
  folder.write("a.mtl", library);
  text = text.substr(0, cut);
  try {
    ninefold::finishScene(
        ninefold::readObj({reinterpret_cast<const unsigned char*>(text.data()), text.size()},
                          ninefold::SceneFolder(folder.path() / "scene.obj")));
  } catch (const ninefold::Error&) {
  }
  return 0;
}
