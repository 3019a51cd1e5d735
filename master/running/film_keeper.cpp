#include "master/running/film_keeper.h"

#include "common/base/log.h"
#include "common/base/release.h"
#include "common/base/written_file.h"
#include "common/scene/methods.h"
#include "common/scene/settings_table.h"
#include "master/output/output_files.h"

namespace ninefold {
namespace {

constexpr double kWriteEvery = 60;  // [s], if --save-every does not say it

std::string wordOf(bool value) { return value ? "on" : "off"; }
std::string wordOf(const Camera& c) {
  return fmt::format("{},{},{}:{},{},{}:{},{},{}:{}:{}", c.eye.x, c.eye.y, c.eye.z, c.forward.x,
                     c.forward.y, c.forward.z, c.up.x, c.up.y, c.up.z, c.verticalFov,
                     c.orthographicHeight);
}
template <typename T>
std::string wordOf(const T& value) {
  return textOf(value);
}

const char* wordOf(SurfaceTest test) {
  return test == SurfaceTest::surface ? "surface" : test == SurfaceTest::paper ? "paper" : "none";
}

}  // namespace

FilmKeeper::FilmKeeper(const Options& options, const Job& job, PictureMaker& picture)
    : options_(options),
      job_(job),
      picture_(picture),
      keeps_(options.checkpoint.has_value()),
      verifies_(options.verify > 0),
      needsState_(isNeededAfterwards(factsOf(job.settings.method).state)) {
  copy_.job = base_.job = rows();
}

// All that the film's bytes depend on.
Checkpoint::Rows FilmKeeper::rows() const {
  Checkpoint::Rows rows{{"release", releaseName()}, {"the scene's hash", job_.sceneHash}};
  forEachSetting(
      [&](const auto& row) { rows.emplace_back(row.name, wordOf(job_.settings.*row.member)); });
  rows.emplace_back("filter", wordOf(options_.surfaceTest));
  rows.emplace_back("filter-at", options_.filterAtClients ? "clients" : "master");
  rows.emplace_back("converging", wordOf(options_.converging));
  rows.emplace_back("view", nameOf(options_.view));
  rows.emplace_back("aovs", wordOf(options_.aovs));
  rows.emplace_back("denoise", wordOf(picture_.isDenoised()));
  return rows;
}

std::optional<FilmKeeper::Begun> FilmKeeper::resume() {
  base_.frames = 0;
  if (verifies_) picture_.keep(base_.film);
  if (!keeps_) return std::nullopt;
  lock_.emplace(*options_.checkpoint);
  auto file = readCheckpoint(*options_.checkpoint, copy_.job, {picture_.keptBytes(), needsState_});
  if (!file) return std::nullopt;
  try {
    picture_.restore(file->film, file->frames);
  } catch (const Error& error) {
    fail("checkpoint {}: {}; give another file", *options_.checkpoint, error.what());
  }
  copy_ = std::move(*file);
  if (verifies_) base_ = copy_;
  log("goes on behind {} frame(s) of {}", copy_.frames, *options_.checkpoint);
  return Begun{copy_.frames,
               copy_.seconds,
               {copy_.pixelClass, copy_.isa, copy_.reproducible, copy_.state, copy_.pages}};
}

void FilmKeeper::reserve() const {
  // A picture hardly takes less than a byte a pixel, however it is packed.
  const TileGrid& grid = job_.shape.grid;
  if (options_.output) checkWritable(*options_.output, pixelCount(grid.width(), grid.height()));
  if (options_.checkpoint) checkWritable(*options_.checkpoint, picture_.keptBytes());
}

void FilmKeeper::stepDone(uint32_t version, const StatePages& pages) {
  if (!keeps_ || !needsState_) return;
  const std::lock_guard lock(mutex_);
  versions_[version] = pages;
}

void FilmKeeper::copy(Checkpoint& to, uint32_t state, double seconds) {
  to.frames = picture_.frames(), to.seconds = seconds;
  to.film.clear();
  picture_.keep(to.film);
  if (!needsState_) return;
  const std::lock_guard lock(mutex_);
  if (const auto version = versions_.find(state); version != versions_.end())
    to.pages = version->second;
  to.state = state;
  versions_.erase(versions_.begin(), versions_.lower_bound(verifies_ ? base_.state : state));
}

bool FilmKeeper::frameDone(const FrameKey& frame, double seconds) {
  if (keeps_) copy(copy_, frame.state, seconds);
  isNew_ = isNew_ || (keeps_ && !verifies_);
  if (!verifies_ || candidate_) return false;
  candidate_.emplace();
  candidate_->job = copy_.job, candidate_->pages = base_.pages;
  candidateFrame_ = frame.frame;
  copy(*candidate_, frame.state, seconds);
  return true;
}

bool FilmKeeper::trusted(uint32_t frame) {
  if (!candidate_ || candidateFrame_ != frame) return false;
  base_ = std::move(*candidate_);
  candidate_.reset();
  isNew_ = keeps_;
  return true;
}

const Checkpoint& FilmKeeper::goBack() {
  candidate_.reset();
  picture_.restore(base_.film, base_.frames);
  if (keeps_) copy_ = base_;
  return base_;
}

void FilmKeeper::writeIfDue(const ServerTally& tally, Time now) {
  if (!isNew_ || now < nextWrite_.value_or(now) || tally.pixelClass.empty()) return;
  nextWrite_ = now + fromSeconds(options_.saveEvery.value_or(kWriteEvery));
  try {
    write(*options_.checkpoint, verifies_ ? base_ : copy_, tally);
  } catch (const Error& error) {
    if (!std::exchange(fails_, true)) warn("{}; the run goes on and tries again", error.what());
  }
}

void FilmKeeper::write(const std::string& file, Checkpoint& what, const ServerTally& tally) {
  if (what.frames == 0) return;
  what.pixelClass = tally.pixelClass, what.isa = tally.isa;
  what.reproducible = tally.reproducible;
  writeCheckpoint(file, what);
  isNew_ = fails_ = false;
}

void FilmKeeper::end(const ServerTally& tally, bool isSettled) {
  if (!keeps_ || copy_.film.empty()) return;
  picture_.restore(copy_.film, copy_.frames);
  if (tally.pixelClass.empty()) return;  // no client came, and the file has all there is
  const bool isAll = verifies_ && isSettled;
  if (!isAll && !isNew_) return;
  writeSomewhere(*options_.checkpoint, [&](const std::string& file) {
    write(file, verifies_ && !isAll ? base_ : copy_, tally);
  });
}

}  // namespace ninefold
