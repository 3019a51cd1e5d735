// video_file.h: pictures as a film, .mp4 (H.264), which the program ffmpeg makes of them.
//
//   pictures --- 8-bit RGB ---> standard input of ffmpeg ---> a file beside NAME, then NAME
//
// Colours are those of the .png files, to the loss of H.264 at a constant quality; a row or column
// of black is added where a side is odd, which H.264 cannot say. ffmpeg works with one thread: the
// same pictures give the same bytes, whatever the machine.
//
// The file is whole or as it was before (written_file.h). ffmpeg ends when its input does, so none
// is left behind. It has kPatience to take a picture, and to end.
//
// Threads: one at a time.
// Errors:  throws Error in one line: no ffmpeg, a full disk, how ffmpeg ended.
// Proved:  tests/cluster/film_test.py.
#pragma once

#include <string>

#include "common/base/clock.h"
#include "common/base/process.h"
#include "common/base/written_file.h"
#include "common/image/tone_map.h"

namespace ninefold {

// Throws unless there is ffmpeg and a file could be written there.
void checkVideo(const std::string& name);

class VideoFile {
 public:
  static constexpr std::chrono::seconds kPatience{120};

  // `rate`: pictures a second. All pictures have this size.
  VideoFile(const std::string& name, int width, int height, double rate);

  void add(const DisplayImage& picture);
  // Last. Without it nothing is to be seen under the name.
  void finish();

 private:
  [[noreturn]] void failWith(const std::string& how);
  ChildProcess::Ending waitForEnd();

  const std::string name_;
  WrittenFile file_;
  Descriptor input_;  // of ffmpeg
  ChildProcess ffmpeg_;
};

}  // namespace ninefold
