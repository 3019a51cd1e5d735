// scene_obj.cpp: any bytes as an OBJ file, and, behind a line "===", as its material library: an
// Error, or a Scene that passes validate.
#include <string>
#include <string_view>

#include "common/base/error.h"
#include "common/scene/obj_reader.h"
#include "tests/fuzz/fuzz.h"
#include "tests/scene/temp_folder.h"

namespace {

constexpr std::string_view kLibrary = "===\n";

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
  return {{text.begin(), text.end()}, {mapped.begin(), mapped.end()}};
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const ninefold::TempFolder folder;  // one for the process: making folders is slow
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
