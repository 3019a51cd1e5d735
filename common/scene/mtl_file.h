// mtl_file.h: an MTL file as it is written: what each material says, and what it does not say.
// mtl_translation.h gives it a meaning.
//
// Keys count in any case. Colours may be one number (grey) or three; Kt is another name of Tf.
// Names end with their line; blanks, tabs and quotes are as in text_lines.h. A line that cannot be
// read is left out, with a warning that names file and line. One warning a file names what nobody
// reads.
// Threads: pure, but for the log.   Errors: throws Error (UTF-16, zero bytes).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/scene/mtl_map.h"

namespace ninefold {

struct MtlMaterial {
  std::string name;
  std::optional<Vec3> Kd, Ks, Ke, Ka, Tf;
  std::optional<float> Ns, Ni, d, Tr;
  std::optional<float> Pr, Pm;       // roughness and metallic, as Blender writes them
  std::optional<float> Ps, Pc, Pcr;  // sheen, clear coat, roughness of the coat
  std::optional<float> illum;
  MtlMap mapKd, mapKs, mapKe, mapD, mapPr, mapPm, norm, bump;
};

// `file`: as warnings shall name it. `exists`: whether a map's name is a file.
std::vector<MtlMaterial> readMtl(std::string_view text, const std::string& file,
                                 const FileExists& exists);

}  // namespace ninefold
