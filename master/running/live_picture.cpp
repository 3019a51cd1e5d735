#include "master/running/live_picture.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "common/sampling/whole_tile.h"
#include "master/assembly/picture.h"

namespace ninefold {
namespace {

bool hasPicks(const FrameShape& shape) { return (shape.extraMask & kPickPlanes) == kPickPlanes; }

}  // namespace

LivePicture::LivePicture(const Setup& setup) : setup_(setup) {
  for (int i = 0; i < setup.workers; ++i) {
    desks_.push_back(std::make_unique<FilterDesk>(setup.test));
    desks_.back()->filter.keepIrradiance(setup.reuses);
  }
}

void LivePicture::begin(const GatheredFrame& frame, const LiveFrame& plan, const LiveLook& look) {
  const std::lock_guard lock(begin_);
  if (current_ == frame.view.key.frame) return;
  current_ = frame.view.key.frame;
  look_ = look;
  const TileGrid& grid = frame.view.shape.grid;
  last_ = plan.last;
  rested_ = !plan.moving && frame.view.shape.layerMask != kDisplayMask;
  if (rested_) beginRest(frame.view.shape, plan.rested == 0);
  traced_ = setup_.reuses && !isFiltered(frame.view.shape);
  if (traced_) {
    if (plan.world != world_) history_.forget();
    world_ = plan.world;
    history_.begin(frame.view.camera, grid.width(), grid.height());
  }
  takeImage(frame.view.shape, !rested_ || plan.rested == 0);
}

void LivePicture::beginRest(const FrameShape& shape, bool isFirst) {
  const TileGrid& grid = shape.grid;
  light_.begin(grid, look_.keeps, isFirst);
  guided_ = look_.denoise && !isFiltered(shape);
  if (look_.denoise) touch_.begin(grid, isFirst);
  const bool isNew = isFirst || look_.view != std::exchange(paintedView_, look_.view);
  if (isPainted(look_.view)) painted_.begin(grid, {.error = false}, isNew);
}

void LivePicture::takeImage(const FrameShape& shape, bool isFirst) {
  const auto isFree = [](const auto& image) { return image.use_count() == 1; };
  image_.reset();
  const auto found = std::ranges::find_if(images_, isFree);
  image_ = found != images_.end() ? *found : images_.emplace_back(std::make_shared<LiveImage>());
  std::atomic_thread_fence(std::memory_order_acquire);  // whoever held it has done with it
  const int width = shape.grid.width(), height = shape.grid.height();
  const bool coded = shape.layerMask == kDisplayMask;
  image_->width = width, image_->height = height;
  image_->radiance.reshape(coded ? 0 : width, coded ? 0 : height);
  image_->tone = look_.tone();
  image_->display.reshape(look_.exposure ? width : 0, look_.exposure ? height : 0);
  if (hasPicks(shape)) {
    picks_ = std::make_shared<PickPlanes>();
    picks_->objects.resize(pixelCount(width, height));
    picks_->depth.resize(pixelCount(width, height));
  } else if (isFirst) {
    picks_.reset();
  }
  image_->picks = picks_;
}

void LivePicture::finishTile(int worker, const GatheredFrame& frame, const LiveFrame& plan,
                             const LiveLook& look, const std::vector<uint32_t>& owners, int tile) {
  begin(frame, plan, look);
  FilterDesk& desk = *desks_[static_cast<size_t>(worker)];
  const FrameShape& shape = frame.view.shape;
  const TaskRect rect = pixelsOf(shape.grid, tile);
  if (shape.layerMask == kDisplayMask)
    return frame.task(tile, 0).copyDisplay(static_cast<size_t>(image_->width),
                                           &image_->display.rgb[3 * image_->at(rect.i0, rect.j0)]);
  if (isFiltered(shape))
    frame.task(tile, 0).copyRadiance(desk.beauty);
  else
    finishLayers(desk, frame, plan.moving, tile);
  if (rested_) addToRest(desk, rect, tile);
  if (!isFiltered(shape)) paintTile(desk, frame.view, owners, tile);
  if (rested_ && isPainted(look_.view)) painted_.addTile(tile, rect, desk);
  rested_ ? showMean(rect) : copyTile(rect, desk.beauty);
  if (look_.exposure) toneMap(rect);
}

void LivePicture::addToRest(const FilterDesk& desk, const TaskRect& rect, int tile) {
  const bool isNew = light_.addTile(tile, rect, desk);
  if (isNew && guided_) touch_.addPatch(desk.patch);
}

void LivePicture::finishLayers(FilterDesk& desk, const GatheredFrame& frame, bool moving,
                               int tile) {
  const FrameView& view = frame.view;
  gather(frame, tile, desk.patch);
  const bool isTwice = rested_ && look_.keeps.neighbours();
  desk.filter.compose(desk.patch, view.camera, view.neighbourWeight, desk.beauty,
                      isTwice ? &desk.unfiltered : nullptr);
  if (traced_) history_.blend(desk.patch, desk.filter, moving, desk.beauty);
  if (hasPicks(view.shape)) keepPickPlanes(desk.patch);
}

void LivePicture::paintTile(FilterDesk& desk, const FrameView& view,
                            const std::vector<uint32_t>& owners, int tile) {
  const auto firstTask = static_cast<size_t>(view.shape.grid.interleave().sets() * tile);
  paint(look_.view, desk.patch, desk.filter, view.neighbourWeight, view.key.rotation,
        setup_.depthScale, &owners[firstTask], desk.beauty);
}

void LivePicture::showMean(const TaskRect& tile) {
  const Film& film = shownFilm().film();
  film.meanOfTile(tile, image_->radiance);
  if (look_.view == PictureView::error) paintError(film, film.frames() + 1, tile, image_->radiance);
}

void LivePicture::copyTile(const TaskRect& tile, const RgbImage& beauty) {
  const RgbPlane& from = beauty.pixels;
  RgbPlane& to = image_->radiance.pixels;
  const auto width = static_cast<size_t>(tile.width);
  for (int y = 0; y < tile.height; ++y) {
    const size_t source = beauty.at(0, y), target = image_->at(tile.i0, tile.j0 + y);
    std::copy_n(&from.r[source], width, &to.r[target]);
    std::copy_n(&from.g[source], width, &to.g[target]);
    std::copy_n(&from.b[source], width, &to.b[target]);
  }
}

void LivePicture::toneMap(const TaskRect& tile) {
  const ToneMap map(look_.tone());
  for (int y = tile.j0; y < tile.j0 + tile.height; ++y) {
    const size_t first = image_->at(tile.i0, y);
    map.apply(image_->radiance.pixels, first, static_cast<size_t>(tile.width),
              &image_->display.rgb[3 * first]);
  }
}

void LivePicture::keepPickPlanes(const Patch& patch) {
  for (int phase = 0; phase < patch.phases(); ++phase) {
    const ExtraPlanes& extras = patch.phase(phase).extras;
    patch.forEachPixel(phase, [&](size_t from, int x, int y) {
      picks_->objects[image_->at(x, y)] = extras.object[from];
      picks_->depth[image_->at(x, y)] = extras.depth[from];
    });
  }
}

void LivePicture::frameDone(const std::stop_token& stop) {
  if (rested_) light_.frameDone();
  if (rested_ && isPainted(look_.view)) painted_.frameDone();
  if (traced_) history_.frameDone();
  if (rested_ && last_) showWholeMean();
  if (rested_ && guided_) touchUp(stop);
}

// Of a still's last frame: tiles have shown the neighbours' share of the frames before it.
void LivePicture::showWholeMean() {
  if (!look_.keeps.neighbours() || !isLight(look_.view)) return;
  light_.film().mean(image_->radiance);
  if (look_.exposure) toneMap({0, 0, image_->width, image_->height});
}

void LivePicture::touchUp(const std::stop_token& stop) {
  touch_.frameDone();
  if (!look_.exposure || !isLight(look_.view)) return;
  touch_.show(light_.film(), image_->radiance, ToneMap(look_.tone()), last_, setup_.workers, stop,
              image_->display);
}

double LivePicture::relativeError() const {
  return rested_ ? shownFilm().film().relativeError() : std::numeric_limits<double>::infinity();
}

}  // namespace ninefold
