#include "master/running/picture_series.h"

#include "common/image/image_file.h"
#include "master/assembly/picture.h"
#include "master/options/numbered_name.h"

namespace ninefold {

std::string PictureSeries::write(int number, const Shown& shown) {
  if (isVideo(*options_.output)) {
    addToFilm(codesOf(shown));
    return *options_.output;
  }
  const std::string path = numbered(*options_.output, number);
  writeFile(path, shown);
  return path;
}

void PictureSeries::finish() {
  if (film_) film_->finish();
}

void PictureSeries::writeFile(const std::string& path, const Shown& shown) {
  if (isToned(path))
    writePng(path, codesOf(shown));
  else
    writeImage(path, {shown.image->radiance, {}, {}});
}

void PictureSeries::addToFilm(const DisplayImage& codes) {
  if (!film_) film_.emplace(*options_.output, codes.width, codes.height, *rate_);
  film_->add(codes);
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
