// gltf_file.h: the parsed but unchecked content of a glTF file. Every file that it names is read
// through the SceneFolder; images stay the compressed bytes that they are. An image that cannot be
// had is no error here: perhaps nothing uses it.
//
// Compressed geometry is decoded (gltf_compression.h).
//
// Threads: reentrant.   Errors: throws Error.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/scene/scene_folder.h"

namespace tinygltf {
class Model;
}

namespace ninefold {

struct GltfFile {
  std::shared_ptr<const tinygltf::Model> model;
  std::map<int, std::string> badImages;  // by index: why it cannot be had
  std::vector<std::string> uris;         // of the tokens that extensions have, see gltf_uri.h
};

// Throws Error, which names it, for an unknown required extension or another version than 2. One
// warning names what nobody reads (gltf_unread.h).
GltfFile parseGltf(std::span<const unsigned char> file, const SceneFolder& folder);

}  // namespace ninefold
