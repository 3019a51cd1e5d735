// What pictures a line bears: lines are simulated.
//
// A picture of b bytes on a line of c bytes/s and round trip r is shown b/c + r/2 after it was
// sent, and known to be shown r/2 later. The viewer then gets the next one at once.
#include "master/web/picture_pace.h"

#include <gtest/gtest.h>

namespace ninefold {
namespace {

struct Line {
  double bytesPerSecond, roundTrip;  // [bytes/s], [s]
};

// Bytes for each pixel that is sent, of rather busy pictures.
constexpr std::array kBytesPerPixel{1.5, 0.35, 0.17, 0.1, 0.1, 0.08};

double bytesOf(size_t form, int width, int height) {
  const PictureForm& how = kPictureForms[form];
  return kBytesPerPixel[form] * width * height / (how.shrink * how.shrink);
}

struct Seen {
  int pictures = 0;
  double oldest = 0;  // when shown [s]
};

// In the last `counted` seconds of `total`.
Seen watch(PicturePace& pace, const Line& line, double total, double counted) {
  Time now{};
  Seen seen;
  while (seconds(now.time_since_epoch()) < total) {
    const double bytes = bytesOf(pace.form(0), 1920, 1080);
    pace.sent(now);
    const double there = bytes / line.bytesPerSecond + line.roundTrip / 2;
    if (seconds(now.time_since_epoch()) >= total - counted) {
      ++seen.pictures;
      seen.oldest = std::max(seen.oldest, there);
    }
    now += fromSeconds(there + line.roundTrip / 2);
    pace.shown(now);
  }
  return seen;
}

// 5 Mbit/s and 50 ms: at least 4 pictures a second, each less than 300 ms old.
TEST(PicturePace, ThinLinesGetFourFreshPicturesASecond) {
  PicturePace pace;
  const Seen seen = watch(pace, {5e6 / 8, 0.05}, 40, 30);
  EXPECT_GE(seen.pictures, 4 * 30);
  EXPECT_LT(seen.oldest, 0.3);
}

TEST(PicturePace, GoodLinesGetFinePictures) {
  PicturePace pace;
  watch(pace, {1e9 / 8, 0.001}, 2, 1);
  EXPECT_EQ(pace.form(0), 1u);                   // in motion, and while it changes much: JPEG
  EXPECT_EQ(pace.form(PicturePace::kCalm), 0u);  // then without loss
}

TEST(PicturePace, ALineThatGetsBetterIsTriedAgain) {
  PicturePace pace;
  watch(pace, {0.5e6 / 8, 0.05}, 20, 1);
  EXPECT_EQ(pace.form(0), kPictureForms.size() - 1);
  watch(pace, {1e9 / 8, 0.001}, 10, 1);
  EXPECT_EQ(pace.form(0), 1u);
}

// 64 good ones in a row are wanted in the end: at most one in 65 is too much for the line.
TEST(PicturePace, AFormThatWasTooMuchIsSeldomTriedAgain) {
  PicturePace pace;
  Time now{};
  int slow = 0;
  for (int i = 0; i < 10000; ++i) {
    const bool isSlow = pace.form(0) < 3;
    slow += isSlow ? 1 : 0;
    pace.sent(now);
    now += isSlow ? milliseconds(250) : milliseconds(50);
    pace.shown(now);
  }
  EXPECT_GT(slow, 0);
  EXPECT_LE(slow, 10000 / 65 + 5);
}

}  // namespace
}  // namespace ninefold
