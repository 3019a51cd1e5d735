// headless_result.cpp: what a run without a window tells and leaves.
#include "common/base/log.h"
#include "common/base/release.h"
#include "common/base/standard_streams.h"
#include "common/base/written_file.h"
#include "master/output/metrics.h"
#include "master/output/output_files.h"
#include "master/running/headless_run.h"

namespace ninefold {

// While it converges. What cannot be written now may be later.
void HeadlessRun::savePicture(const PictureMaker::Copy& copy) {
  saveAsked_.reset();
  try {
    writePicture(*options_.output, copy);
    tellPicture(copy);
    savedFrames_ = copy.frames;
    saveFails_ = false;
  } catch (const Error& error) {
    if (!std::exchange(saveFails_, true)) warn("{}; the run goes on and tries again", error.what());
  }
  if (nextSave_) nextSave_ = Clock::now() + fromSeconds(*options_.saveEvery);
}

void HeadlessRun::writeMetrics(const ServerTally& tally) {
  constexpr Duration kEvery = std::chrono::seconds(10);
  if (!options_.metrics) return;
  nextMetrics_ = Clock::now() + kEvery;
  try {
    writeFile(*options_.metrics, metricsText({.tally = tally,
                                              .clients = cluster().clients(),
                                              .framesInPicture = picture_.frames(),
                                              .relativeError = picture_.relativeError()}));
    metricsFail_ = false;
  } catch (const Error& error) {
    if (!std::exchange(metricsFail_, true)) warn("{}; the run goes on", error.what());
  }
}

void HeadlessRun::tellProgress() {
  if (const auto text = progress_.update(progressState(), Clock::now())) sayToPeople(*text);
}

ProgressState HeadlessRun::progressState() const {
  const double fraction = rule_.fraction(picture_.frames(), elapsed(), picture_.relativeError());
  return {.fraction = fraction,
          .frames = picture_.frames(),
          .of = rule_.frames,
          .begun = cluster().firstDispatch(),
          .before = fractionBefore_,
          .note = cluster().summary()};
}

void HeadlessRun::writeLastPicture() const {
  if (!options_.output) return;
  const PictureMaker::Copy copy = picture_.copy();
  writeSomewhere(*options_.output, [&](const std::string& path) { writePicture(path, copy); });
  tellPicture(copy);
}

// Who waits for a new picture reads this line: Blender's add-on does.
void HeadlessRun::tellPicture(const PictureMaker::Copy& copy) const {
  log("{} frame(s) in {}", copy.frames, *options_.output);
}

void HeadlessRun::writePicture(const std::string& path, const PictureMaker::Copy& copy) const {
  picture_.write(path,
                 {{"release", releaseName()},
                  {"scene", options_.scene},
                  {"scene_hash", job_.sceneHash},
                  {"camera", job_.settings.camera.name},
                  {"preset", nameOf(options_.preset)},
                  {"denoise", picture_.isDenoised() ? "on" : "off"},
                  {"seed", fmt::format("{}", job_.settings.seed)},
                  {"frames", fmt::format("{}", copy.frames)},
                  {"image_hash", copy.imageHash}},
                 copy);
}

// The line that the run ends with if nobody could settle who is wrong; else empty.
std::string HeadlessRun::tellVerification() const {
  if (options_.verify == 0) return {};
  const VerificationCounts counts = cluster().server().tally().verification;
  if (counts.alone > 0)
    warn(
        "{} of the results that --verify chose were not checked: no second client of the same "
        "kind was there",
        counts.alone);
  if (counts.disputed == 0) return {};
  return fmt::format(
      "{} result(s) differ between two clients, and no third one of their kind was there to tell "
      "which is right: the picture may be wrong; let a third client join",
      counts.disputed);
}

void HeadlessRun::writeStatistics() const {
  if (!options_.stats) return;
  RunStats stats = record_.stats(cluster().server(), machine_.busy(), FrameMachine::workers());
  stats.stalls = cluster().stalls();
  stats.frames = picture_.frames(), stats.framesBefore = framesBefore_;
  stats.relativeError = picture_.relativeError();
  if (options_.verify > 0) {
    const ServerTally tally = cluster().server().tally();
    stats.verify = {tally.verification, tally.expelled, framesAgain_};
  }
  stats.imageHash = picture_.imageHash();
  stats.needs = job_.needs;
  stats.preset = nameOf(options_.preset);
  stats.settings = job_.settings;
  stats.surfaceTest = options_.surfaceTest;
  stats.denoise = options_.output && picture_.isDenoised();
  writeStats(*options_.stats, toJson(stats));
}

}  // namespace ninefold
