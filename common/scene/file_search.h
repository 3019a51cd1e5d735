// file_search.h: where a file is that an OBJ or MTL file names.
//
// Beside the file that names it, else in the scene's folder; where both fail, as with paths of
// other machines, the name without its folders, in these two places; last, all that in any case.
// Nothing outside the scene's folder is found.
// Errors: none. Threads: reentrant.
#pragma once

#include <optional>
#include <string>

#include "common/scene/scene_folder.h"

namespace ninefold {

// As a path from the scene's folder. `beside`: the folder of the file that names it, empty or
// ending in '/'.
std::optional<std::string> findFile(const SceneFolder& folder, const std::string& beside,
                                    const std::string& name);

}  // namespace ninefold
