// gltf_file.h: the parsed but unchecked content of a glTF file. Every file that it names is read
// through the SceneFolder; images stay as the compressed bytes that they are.
// Errors: throws Error.
// Threads: reentrant.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "common/scene/scene_folder.h"

namespace tinygltf {
class Model;
}

namespace ninefold {

// An unknown required extension is an error that names it; unknown optional ones give one warning.
std::shared_ptr<const tinygltf::Model> parseGltf(std::span<const unsigned char> file,
                                                 const SceneFolder& folder);

}  // namespace ninefold
