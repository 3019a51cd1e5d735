#include "master/running/picture_series.h"

#include <filesystem>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/image/image_file.h"
#include "master/assembly/picture.h"
#include "master/options/numbered_name.h"

namespace ninefold {
namespace {

std::string nameOfKept(const std::string& film, int number) {
  return numbered(film + ".####.png", number);
}

}  // namespace

std::string PictureSeries::write(int number, const Shown& shown) {
  if (isVideo(*options_.output)) {
    addToFilm(number, codesOf(shown));
    return *options_.output;
  }
  const std::string path = numbered(*options_.output, number);
  writeFile(path, shown);
  return path;
}

void PictureSeries::finish() {
  if (kept_ == 0) return;
  if (broken_) failWithPictures(*broken_);
  try {
    film_->finish();
  } catch (const Error& e) {
    failWithPictures(e.what());
  }
  for (int i = 0; i < kept_; ++i) std::filesystem::remove(nameOfKept(*options_.output, i));
}

void PictureSeries::failWithPictures(const std::string& why) const {
  fail(
      "{}; nothing is lost, this makes the film: ffmpeg -framerate {} -i {}.%04d.png -frames:v {} "
      "{}",
      why, *rate_, *options_.output, kept_, *options_.output);
}

void PictureSeries::writeFile(const std::string& path, const Shown& shown) {
  if (isToned(path))
    writePng(path, codesOf(shown));
  else
    writeImage(path, {shown.image->radiance, {}, {}});
}

void PictureSeries::addToFilm(int number, const DisplayImage& codes) {
  writePng(nameOfKept(*options_.output, number), codes);
  ++kept_;
  if (broken_) return;
  try {
    if (!film_) film_.emplace(*options_.output, codes.width, codes.height, *rate_);
    film_->add(codes);
  } catch (const Error& e) {
    film_.reset();
    broken_ = e.what();
    warn("{}; the pictures go on as {}.####.png", *broken_, *options_.output);
  }
}

// Made with the frame, if its exposure was known then.
const DisplayImage& PictureSeries::codesOf(const Shown& shown) {
  if (!shown.image->display.rgb.empty()) return shown.image->display;
  Tone tone;
  if (!isFalseColor(shown.view)) {
    if (!exposure_) exposure_ = exposureByPicture(shown.image->radiance);
    tone = {*exposure_, options_.toneCurve};
  }
  ToneMap(tone).apply(shown.image->radiance, codes_);
  return codes_;
}

}  // namespace ninefold
