// obj_folder.h: a folder in which tests write OBJ and MTL files and read them as scenes.
#pragma once

#include <gtest/gtest.h>

#include "common/scene/reader.h"
#include "tests/scene/one_line_error.h"
#include "tests/scene/png_bytes.h"
#include "tests/scene/temp_folder.h"

namespace ninefold {

inline const std::string kSquare =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";

class ObjFolder : public testing::Test {
 protected:
  Scene read(const std::string& text) { return readScene(folder.write("scene.obj", text)); }

  // The square with one material whose lines these are.
  Scene square(const std::string& lines) {
    folder.write("a.mtl", "newmtl m\n" + lines);
    return read("mtllib a.mtl\n" + kSquare + "usemtl m\nf 1/1 2/2 3/3 4/4\n");
  }
  Material material(const std::string& lines) { return square(lines).materials.at(0); }

  void picture(const std::string& name, int width, int height, int channels,
               const std::vector<unsigned char>& texels) {
    folder.write(name, png(width, height, channels, texels));
  }

  // What reading them says on the log.
  std::string logOf(const std::string& lines) {
    testing::internal::CaptureStderr();
    square(lines);
    return testing::internal::GetCapturedStderr();
  }
  std::string logOfFile(const std::string& text) {
    testing::internal::CaptureStderr();
    read(text);
    return testing::internal::GetCapturedStderr();
  }

  // The error, without the file's name in front of it.
  std::string error(const std::string& text) {
    const std::string what = errorOf([&] { read(text); });
    const std::string file = (folder.path() / "scene.obj").string() + ": ";
    EXPECT_EQ(what.find(file), 0u) << what;
    return what.substr(std::min(what.size(), file.size()));
  }
  std::string errorOfMaterial(const std::string& lines) {
    folder.write("a.mtl", "newmtl m\n" + lines);
    return error("mtllib a.mtl\n" + kSquare + "usemtl m\nf 1/1 2/2 3/3 4/4\n");
  }

  TempFolder folder;
};

inline const TextureImage& imageOf(const Scene& scene, const TextureUse& use) {
  return scene.images[static_cast<size_t>(use.image)];
}

}  // namespace ninefold
