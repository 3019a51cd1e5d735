// gltf_image_light.h: light from outside that a glTF file brings along: EXT_lights_image_based, six
// pictures of a cube's faces, as a picture of all directions (environment_map.h).
//
//   L(w) = intensity face(R^-1 w)     R: rotation; the sharpest of the file's versions of each face
//
// A face shows what an eye in the middle of the cube sees, upright but for +y and -y. A PNG with
// four channels is RGBD: the sRGB colour, decoded, over alpha. Others are sRGB. Each texel of the
// new picture is the mean of kFine x kFine places. The file's spherical harmonics say the same,
// blurred, and are not used.
//
// Source:  EXT_lights_image_based of glTF's registry; order and axes of the faces are those of
//          OpenGL's cube maps, mirrored left to right, as the extension asks.
// Proved:  tests/scene/gltf_image_light_test.cpp.
// Threads: reentrant.
// Errors:  none: what cannot be read is a warning that says what is missing, and there is no light.
#pragma once

#include <memory>

#include "common/scene/environment_map.h"
#include "common/scene/gltf_file.h"

namespace ninefold {

struct ImageLight {
  std::shared_ptr<const EnvironmentMap> map;  // null: the scene has none
  float intensity = 1;
};

ImageLight readImageLight(const GltfFile& file);

}  // namespace ninefold
