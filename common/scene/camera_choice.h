// camera_choice.h: which camera --camera means.
//
//   NAME             a camera of the file, by its name
//   INDEX            a camera of the file, from 0; a name that is a number wins over it
//   eye:target:fov   x,y,z and x,y,z in the file's coordinates, and the full vertical angle in
//                    degrees; up is +y, or +z when looking straight up or down
//   eye:target:HEIGHTm   the same, orthographic: the height of what the picture shows, in metres
//   (empty)          the scene's first camera
//
// Threads: pure.   Errors: throws Error that lists the cameras.
#pragma once

#include <string>
#include <string_view>

#include "common/scene/scene.h"

namespace ninefold {

Camera chooseCamera(const Scene& scene, std::string_view spec);

// `camera` as eye:target:fov, or with a height. How it is turned about its line of sight is lost.
std::string specOf(const Scene& scene, const Camera& camera);

}  // namespace ninefold
