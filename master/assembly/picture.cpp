#include "master/assembly/picture.h"

#include "common/base/log.h"
#include "common/image/auto_exposure.h"
#include "common/sampling/whole_tile.h"

namespace ninefold {
void gather(const GatheredFrame& frame, int tile, Patch& patch) {
  const FrameShape& shape = frame.view.shape;
  patch.reset(shape, tile);
  uint8_t bright = 0, glowing = 0;
  const auto forEachTask = [&](const auto& f) {
    forEachAround(shape.grid, tile, 1, [&](int around) {
      for (int phase = 0; phase < patch.phases(); ++phase) f(around, phase);
    });
  };
  forEachTask([&](int around, int phase) {
    bright |= frame.task(around, phase).bright();
    glowing |= frame.task(around, phase).glowing();
  });
  patch.lighten(bright);
  patch.setGlow(glowing);
  forEachTask([&](int around, int phase) {
    // Results have waited for each other in memory: the next one comes while this one is decoded.
    if (around == tile && phase + 1 < patch.phases()) frame.task(around, phase + 1).prefetch();
    const Patch::Overlap part = patch.overlap(phase, shape.grid.rect(around, phase));
    frame.task(around, phase)
        .copy({part.fromI, part.fromJ, part.to, part.width, part.height}, bright, glowing,
              Patch::kSide, patch.phase(phase));
  });
}

void addTile(Film& film, const FilterDesk& desk, const TaskRect& rect) {
  if (film.keeps().neighbours())
    film.addTile(rect.i0, rect.j0, desk.unfiltered, &desk.beauty);
  else
    film.addTile(rect.i0, rect.j0, desk.beauty);
}

namespace {

bool isTouched(const PictureMaker::Setup& setup) {
  return setup.denoise && isLight(setup.view) && !isFiltered(setup.shape);
}

FilmKeeps keepsOf(const PictureMaker::Setup& setup) {
  FilmKeeps keeps = setup.keeps;
  keeps.error |= isTouched(setup);
  return keeps;
}

}  // namespace

PictureMaker::PictureMaker(const Setup& setup)
    : setup_(setup), film_(setup.shape.grid.width(), setup.shape.grid.height(), keepsOf(setup)) {
  if (isTouched(setup)) guides_.emplace(film_.width(), film_.height());
  if (setup.aovMask != 0) aovs_.emplace(setup.shape.grid, setup.aovMask);
  for (int i = 0; i < setup.workers; ++i)
    desks_.push_back(std::make_unique<FilterDesk>(setup.surfaceTest));
}

void PictureMaker::finishTile(int worker, const GatheredFrame& frame, int tile) {
  FilterDesk& desk = *desks_[static_cast<size_t>(worker)];
  if (isFiltered(frame.view.shape)) return addFiltered(desk, frame, tile);
  gather(frame, tile, desk.patch);
  desk.filter.compose(desk.patch, frame.view.camera, frame.view.neighbourWeight, desk.beauty,
                      setup_.keeps.neighbours() ? &desk.unfiltered : nullptr);
  paint(setup_.view, desk.patch, desk.filter, frame.view.neighbourWeight, frame.view.key.rotation,
        setup_.depthScale, nullptr, desk.beauty);
  addTile(film_, desk, pixelsOf(frame.view.shape.grid, tile));
  if (aovs_) aovs_->addPatch(desk.patch);
  if (guides_) guides_->addPatch(desk.patch);
}

void PictureMaker::addFiltered(FilterDesk& desk, const GatheredFrame& frame, int tile) {
  const TaskRect rect = pixelsOf(frame.view.shape.grid, tile);
  frame.task(tile, 0).copyRadiance(desk.beauty);
  film_.addTile(rect.i0, rect.j0, desk.beauty);
}

void PictureMaker::frameDone() {
  film_.frameDone();
  if (setup_.view == PictureView::error) film_.updateShare();
  if (aovs_) aovs_->frameDone();
  if (guides_) guides_->frameDone();
}

std::string PictureMaker::imageHash() const {
  RgbImage mean;
  film_.mean(mean);
  return ninefold::imageHash(mean);
}

std::vector<Channel> PictureMaker::extraChannels() const {
  if (!aovs_) return {};
  std::vector<Channel> channels = aovs_->channels();
  channels.push_back({"error.Y", film_.standardError()});
  return channels;
}

PictureMaker::Copy PictureMaker::copy() const {
  Copy copy;
  film_.mean(copy.mean);
  copy.imageHash = ninefold::imageHash(copy.mean);
  copy.frames = film_.frames();
  if (guides_) copy.error = film_.standardError(), copy.guides = guides_->guides();
  if (setup_.view == PictureView::error)
    paintError(film_, film_.frames(), {0, 0, copy.mean.width, copy.mean.height}, copy.mean);
  copy.extras = extraChannels();
  return copy;
}

void PictureMaker::write(const std::string& path, const Metadata& metadata,
                         const Copy& copy) const {
  RgbImage picture = copy.mean;
  if (guides_) denoise(picture, copy.error, copy.guides, setup_.workers);
  Tone tone;
  if (path.ends_with(".png") && !isFalseColor(setup_.view))
    tone = {setup_.exposure ? *setup_.exposure : exposureByPicture(picture), setup_.curve};
  writeImage(path, {picture, copy.extras, metadata}, ToneMap(tone));
}

float exposureByPicture(const RgbImage& radiance) {
  const float ev = autoExposure(radiance);
  log("exposure {:+.1f} EV, by the picture; --exposure {:.1f} says the same, --exposure 0 leaves "
      "light as it is",
      ev, ev);
  return ev;
}

}  // namespace ninefold
