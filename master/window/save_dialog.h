// save_dialog.h: Control+S: asks once for a file's name in the window, and writes the scene.
// Threads: the main thread.
// Errors: a notice tells what cannot be written, and the name is asked for again.
#pragma once

#include <array>
#include <functional>

#include "common/scene/scene.h"
#include "master/interaction/notice.h"
#include "master/interaction/save_target.h"
#include "master/window/window.h"

namespace ninefold {

class SaveDialog {
 public:
  // `written`: the scene of this moment is in the file.
  SaveDialog(const std::string& scenePath, std::function<Scene()> scene,
             std::function<void()> written, Notice& notice)
      : target_(scenePath),
        scene_(std::move(scene)),
        written_(std::move(written)),
        notice_(notice) {}

  void save();  // into the file, or asks for it
  void draw(Window& window);

 private:
  void write();
  void choose();

  SaveTarget target_;
  std::function<Scene()> scene_;
  std::function<void()> written_;
  Notice& notice_;
  bool open_ = false, isNew_ = false;
  std::array<char, 1024> name_{};
  std::string question_;
};

}  // namespace ninefold
