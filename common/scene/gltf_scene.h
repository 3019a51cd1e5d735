// gltf_scene.h: the node tree of a glTF file: what stands where. Only what the default scene
// reaches is read. Matrices are multiplied in double precision. A scene may carry the exposure that
// it is meant to be shown with, as extras.exposure [EV].
// Threads: reentrant.   Errors: throws Error.
#pragma once

#include <span>

#include "common/scene/reader.h"
#include "common/scene/scene_draft.h"
#include "common/scene/scene_folder.h"

namespace ninefold {

// `file`: content of a .gltf or .glb; `folder`: where its other files are.
SceneDraft readGltf(std::span<const unsigned char> file, const SceneFolder& folder,
                    const ReadOptions& options);

}  // namespace ninefold
