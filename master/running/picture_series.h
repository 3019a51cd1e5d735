// picture_series.h: the pictures of a script as they are written: each into a file of its own, or
// all into one film. Colours of a script without an exposure are by its first picture, so that
// nothing flickers.
//
//   film x.mp4   each picture is also x.mp4.####.png until the film is whole. If ffmpeg fails, the
//                rest becomes .png alone, and finish tells how a film is made of them.
//
// Threads: one at a time.   Errors: Error that names the file.
// Proved:  tests/cluster/script_test.py, film_test.py.
#pragma once

#include <optional>
#include <string>

#include "master/options/options.h"
#include "master/output/video_file.h"
#include "master/running/live_run.h"

namespace ninefold {

class PictureSeries {
 public:
  // `exposure`: of the job. `rate`: of a film, pictures a second. Needs options.output.
  PictureSeries(const Options& options, std::optional<float> exposure, std::optional<double> rate)
      : options_(options), exposure_(exposure), rate_(rate) {}

  // The next one in order; `number` is that of its file. Gives the file's name.
  std::string write(int number, const Shown& shown);
  // The only one.
  void writeAlone(const Shown& shown) { writeFile(*options_.output, shown); }
  // Last: a film is there from now on, or throws and its pictures stay.
  void finish();

 private:
  void writeFile(const std::string& path, const Shown& shown);
  void addToFilm(int number, const DisplayImage& codes);
  [[noreturn]] void failWithPictures(const std::string& why) const;
  const DisplayImage& codesOf(const Shown& shown);

  const Options& options_;
  std::optional<float> exposure_;  // [EV] by the first picture, if the job has none
  const std::optional<double> rate_;
  DisplayImage codes_;
  std::optional<VideoFile> film_;
  int kept_ = 0;                       // pictures of the film
  std::optional<std::string> broken_;  // why there is no film any more
};

}  // namespace ninefold
