// obj_reader.h: Wavefront OBJ with MTL materials.
// Threads: reentrant.   Errors: throws Error.
#pragma once

#include <span>

#include "common/scene/scene_draft.h"
#include "common/scene/scene_folder.h"

namespace ninefold {

// `file`: content of the .obj; `folder`: where its materials and textures are.
SceneDraft readObj(std::span<const unsigned char> file, const SceneFolder& folder);

}  // namespace ninefold
