// picture_pace.h: what pictures a viewer's line bears, found by how long each takes from the moment
// that it is sent until the page has shown it. Pure: the time is told.
//
//   longer than kSlow     the next form is coarser (twice as long: by two)
//   shorter than kFast    so many times in a row: the next form is finer; after each time that this
//                         was too much for the line, four times as many, up to 64
//
// One picture is under way at most, so that what a viewer sees is at most about kSlow old, however
// thin its line. At rest a picture gets better by ever less: from kCalm frames on it is sent
// seldom (web_hub.h), and without loss if the line bears it.
// Threads: plain value.   Errors: none.   Proved: tests/web/picture_pace_test.cpp.
#pragma once

#include <array>
#include <cstdint>

#include "common/base/clock.h"

namespace ninefold {

// How a picture is sent.
struct PictureForm {
  int quality = 0;  // of JPEG; 0: PNG
  int shrink = 1;   // pixels of the picture for each that is sent, along each side
  bool operator==(const PictureForm&) const = default;
};

inline constexpr std::array kPictureForms{PictureForm{0, 1},  PictureForm{92, 1},
                                          PictureForm{80, 1}, PictureForm{60, 1},
                                          PictureForm{60, 2}, PictureForm{50, 4}};

class PicturePace {
 public:
  static constexpr Duration kSlow = milliseconds(200);
  static constexpr Duration kFast = milliseconds(100);
  static constexpr int64_t kCalm = 16;  // frames at rest

  // Into kPictureForms. `frames`: that the picture is the mean of; moving: 0.
  size_t form(int64_t frames) const;
  void sent(Time now) { sentAt_ = now; }
  void shown(Time now);

 private:
  void coarser(size_t steps);

  size_t form_ = 2;
  int fast_ = 0, needed_ = 4;  // in a row
  Time sentAt_ = Time::min();
};

}  // namespace ninefold
