#include "master/live_picture.h"

#include <algorithm>
#include <limits>

#include "common/sampling/whole_tile.h"
#include "master/picture.h"

namespace ninefold {
namespace {

constexpr uint8_t kPickPlanes = kObjectPlane | kDepthPlane;

}  // namespace

LivePicture::LivePicture(SurfaceTest test, int workers, float depthScale, bool reuses)
    : depthScale_(depthScale), reuses_(reuses) {
  for (int i = 0; i < workers; ++i) {
    desks_.push_back(std::make_unique<Desk>(test));
    desks_.back()->filter.keepIrradiance(reuses);
  }
}

void LivePicture::begin(const GatheredFrame& frame, const LiveFrame& plan, const LiveLook& look) {
  const std::lock_guard lock(begin_);
  if (current_ == frame.view.key.frame) return;
  current_ = frame.view.key.frame;
  look_ = look;
  const TileGrid& grid = frame.view.shape.grid;
  rested_ = !plan.moving && frame.view.shape.layerMask != kDisplayMask;
  const bool wantsError = look.view == PictureView::error;  // views change at a rest's beginning
  const bool fits = film_ && film_->width() == grid.width() && film_->height() == grid.height() &&
                    keepsError_ == wantsError && film_->twoRadii() == look.twoRadii;
  if (rested_ && !fits)
    film_ = std::make_unique<Film>(grid.width(), grid.height(), keepsError_ = wantsError,
                                   look.twoRadii);
  else if (rested_ && plan.rested == 0)
    film_->clear();
  traced_ = reuses_ && !isFiltered(frame.view.shape);
  if (traced_) {
    if (plan.world != world_) history_.forget();
    world_ = plan.world;
    history_.begin(frame.view.camera, grid.width(), grid.height());
  }
  takeImage(frame.view.shape);
}

void LivePicture::takeImage(const FrameShape& shape) {
  const auto isFree = [](const auto& image) { return image.use_count() == 1; };
  image_.reset();
  const auto found = std::ranges::find_if(images_, isFree);
  image_ = found != images_.end() ? *found : images_.emplace_back(std::make_shared<LiveImage>());
  std::atomic_thread_fence(std::memory_order_acquire);  // whoever held it has done with it
  const int width = shape.grid.width(), height = shape.grid.height();
  const bool coded = shape.layerMask == kDisplayMask;
  image_->width = width, image_->height = height;
  image_->radiance.reshape(coded ? 0 : width, coded ? 0 : height);
  image_->exposure = look_.exposure.value_or(0);
  image_->display.reshape(look_.exposure ? width : 0, look_.exposure ? height : 0);
  const bool picks = (shape.extraMask & kPickPlanes) == kPickPlanes;
  image_->objects.resize(picks ? pixelCount(width, height) : 0);
  image_->depth.resize(image_->objects.size());
}

void LivePicture::finishTile(int worker, const GatheredFrame& frame, const LiveFrame& plan,
                             const LiveLook& look, const std::vector<uint32_t>& owners, int tile) {
  begin(frame, plan, look);
  Desk& desk = *desks_[static_cast<size_t>(worker)];
  const FrameShape& shape = frame.view.shape;
  const TaskRect rect = pixelsOf(shape.grid, tile);
  if (shape.layerMask == kDisplayMask)
    return frame.task(tile, 0).copyDisplay(static_cast<size_t>(image_->width),
                                           &image_->display.rgb[3 * image_->at(rect.i0, rect.j0)]);
  if (isFiltered(shape))
    frame.task(tile, 0).copyRadiance(desk.beauty);
  else
    finishLayers(desk, frame, plan.moving,
                 &owners[static_cast<size_t>(shape.grid.interleave().sets() * tile)], tile);
  rested_ ? sumUp(rect, desk.beauty) : copyTile(rect, desk.beauty);
  if (look_.exposure) toneMap(rect);
}

void LivePicture::finishLayers(Desk& desk, const GatheredFrame& frame, bool moving,
                               const uint32_t* owners, int tile) {
  const FrameView& view = frame.view;
  gather(frame, tile, desk.patch);
  desk.filter.compose(desk.patch, view.camera, view.neighbourWeight, desk.beauty);
  if (traced_) history_.blend(desk.patch, desk.filter, moving, desk.beauty);
  paint(look_.view, desk.patch, desk.filter, view.neighbourWeight, view.key.rotation, depthScale_,
        owners, desk.beauty);
  keepPickPlanes(desk.patch);
}

void LivePicture::sumUp(const TaskRect& tile, const RgbImage& beauty) {
  film_->addTile(tile.i0, tile.j0, beauty);
  film_->meanOfTile(tile, image_->radiance);
  if (look_.view == PictureView::error)
    paintError(*film_, film_->frames() + 1, tile, image_->radiance);
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
  const ToneMap map(*look_.exposure);
  for (int y = tile.j0; y < tile.j0 + tile.height; ++y) {
    const size_t first = image_->at(tile.i0, y);
    map.apply(image_->radiance.pixels, first, static_cast<size_t>(tile.width),
              &image_->display.rgb[3 * first]);
  }
}

void LivePicture::keepPickPlanes(const Patch& patch) {
  if (image_->objects.empty()) return;
  for (int phase = 0; phase < patch.phases(); ++phase) {
    const ExtraPlanes& extras = patch.phase(phase).extras;
    patch.forEachPixel(phase, [&](size_t from, int x, int y) {
      image_->objects[image_->at(x, y)] = extras.object[from];
      image_->depth[image_->at(x, y)] = extras.depth[from];
    });
  }
}

void LivePicture::frameDone() {
  if (rested_) film_->frameDone();
  if (traced_) history_.frameDone();
}

double LivePicture::relativeError() const {
  return rested_ ? film_->relativeError() : std::numeric_limits<double>::infinity();
}

}  // namespace ninefold
