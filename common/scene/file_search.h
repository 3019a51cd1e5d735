// file_search.h: finds the file that an OBJ or MTL file names. Places, in this order:
//
//   1  beside the file that names it, then in the scene's folder
//   2  the name without its folders, in the same two places, for paths of other machines
//   3  all of that again, in any case of the letters
//
// Nothing outside the scene's folder is found.
// Threads: reentrant.   Errors: none.
#pragma once

#include <optional>
#include <string>

#include "common/scene/scene_folder.h"

namespace ninefold {

// Returns a path from the scene's folder. `beside`: the folder of the file that names `name`, empty
// or ending in '/'.
std::optional<std::string> findFile(const SceneFolder& folder, const std::string& beside,
                                    const std::string& name);

}  // namespace ninefold
