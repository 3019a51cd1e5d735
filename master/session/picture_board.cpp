#include "master/session/picture_board.h"

#include <filesystem>

#include "common/base/log.h"
#include "common/image/image_file.h"
#include "master/session/picking.h"

namespace ninefold {
namespace {

constexpr size_t kTimesShown = 120;
constexpr double kRatesEvery = 0.5;  // [s]

// The next one that no file has.
std::string freeName(const char* name, int& number, const std::string& extension) {
  std::error_code ignored;
  std::string path;
  do path = fmt::format("{}.{:04}.{}", name, ++number, extension);
  while (std::filesystem::exists(path, ignored));
  return path;
}

}  // namespace

bool PictureBoard::take(const std::shared_ptr<const Shown>& latest, uint64_t tasks) {
  if (latest == shown_) return false;
  const bool first = !shown_;
  shown_ = latest;
  if (!first)
    frameTimes_.push_back(
        static_cast<float>(1e3 * seconds(latest->completed - latest->frame.opened)));
  if (frameTimes_.size() > kTimesShown) frameTimes_.erase(frameTimes_.begin());
  count(tasks);
  if (recording_) save("png");
  if (waiting_ && shown_->image->radiance.count() > 0) save(*std::exchange(waiting_, {}));
  return true;
}

void PictureBoard::count(uint64_t tasks) {
  const double past = seconds(shown_->completed - ratesAt_);
  if (past < kRatesEvery) return;
  const uint64_t rays = shown_->rays.total();
  raysPerSecond_ = static_cast<double>(rays - raysThen_) / past;
  tasksPerSecond_ = static_cast<double>(tasks - tasksThen_) / past;
  raysThen_ = rays, tasksThen_ = tasks, ratesAt_ = shown_->completed;
}

Tone PictureBoard::toneShown() const { return isFalseColor(shown_->view) ? Tone{} : tone_; }

const DisplayImage* PictureBoard::draw(const Scene& scene,
                                       const std::optional<Selection>& selection) {
  if (!shown_) return nullptr;
  Drawn now{shown_.get(), toneShown(), selection};
  if (now == drawn_) return nullptr;
  drawn_ = std::move(now);
  const DisplayImage& codes = display();
  if (!selection) return &codes;
  outlined_ = codes;
  drawOutline(*shown_, scene, *selection, outlined_.rgb);
  return &outlined_;
}

// The workers made the codes with the picture. They are made anew only if exposure or curve have
// changed since. Codes from clients stay: the next frame is at hand.
const DisplayImage& PictureBoard::display() {
  const LiveImage& image = *shown_->image;
  if (image.tone == toneShown() || image.radiance.count() == 0) return image.display;
  ToneMap(toneShown()).apply(image.radiance, exposed_);
  return exposed_;
}

void PictureBoard::save(const std::string& extension) {
  if (!shown_) return;
  if (extension != "png" && shown_->image->radiance.count() == 0) {
    waiting_ = extension;
    return;
  }
  const std::string path = recording_ ? freeName("record", recorded_, extension)
                                      : freeName("ninefold", saved_, extension);
  try {
    write(path);
    notice_.say("picture in " + std::filesystem::absolute(path).string());
  } catch (const Error& error) {
    notice_.complain(error.what());
    recording_ = false;
  }
}

void PictureBoard::write(const std::string& path) {
  if (path.ends_with(".png")) return writePng(path, display());
  writeImage(path, {shown_->image->radiance, {}, {}});
}

void PictureBoard::tell(PanelView& view) const {
  view.shown = shown_.get();
  view.frameTimes = frameTimes_;
  view.raysPerSecond = raysPerSecond_, view.tasksPerSecond = tasksPerSecond_;
  view.tone = tone_;
  view.recording = recording_;
}

}  // namespace ninefold
