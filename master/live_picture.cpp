#include "master/live_picture.h"

#include "master/picture.h"

namespace ninefold {

LivePicture::LivePicture(SurfaceTest test, int workers, float depthScale)
    : depthScale_(depthScale) {
  for (int i = 0; i < workers; ++i) desks_.push_back(std::make_unique<Desk>(test));
}

void LivePicture::begin(const GatheredFrame& frame, const LiveFrame& plan, PictureView view) {
  const std::lock_guard lock(begin_);
  if (current_ == frame.view.key.frame) return;
  current_ = frame.view.key.frame;
  view_ = view;
  const TileGrid& grid = frame.view.shape.grid;
  rested_ = !plan.moving;
  const bool fits = film_ && film_->width() == grid.width() && film_->height() == grid.height();
  if (rested_ && !fits)
    film_ = std::make_unique<Film>(grid.width(), grid.height());
  else if (rested_ && plan.rested == 0)
    film_->clear();
  if (frame_.width != grid.width() || frame_.height != grid.height())
    frame_.reset(grid.width(), grid.height());
  constexpr uint8_t kPick = kObjectPlane | kDepthPlane;
  const bool picks = (frame.view.shape.extraMask & kPick) == kPick;
  objects_.resize(picks ? frame_.count() : 0);
  depth_.resize(objects_.size());
}

void LivePicture::finishTile(int worker, const GatheredFrame& frame, const LiveFrame& plan,
                             PictureView view, const std::vector<uint32_t>& owners, int tile) {
  begin(frame, plan, view);
  Desk& desk = *desks_[static_cast<size_t>(worker)];
  gather(frame, tile, desk.patch);
  desk.filter.compose(desk.patch, frame.view.camera, frame.view.neighbourWeight, desk.beauty);
  const size_t sets = static_cast<size_t>(desk.patch.phases());
  paint(view_, desk.patch, desk.filter, frame.view.neighbourWeight, frame.view.key.rotation,
        depthScale_, owners.data() + static_cast<size_t>(tile) * sets, desk.beauty);
  keepPickPlanes(desk.patch);
  if (rested_)
    film_->addTile(desk.patch.x0(), desk.patch.y0(), desk.beauty);
  else
    keepTile(desk);
}

void LivePicture::keepTile(const Desk& desk) {
  const RgbPlane& from = desk.beauty.pixels;
  for (int y = 0; y < desk.beauty.height; ++y) {
    const size_t source = desk.beauty.at(0, y);
    const size_t to = frame_.at(desk.patch.x0(), desk.patch.y0() + y);
    const auto width = static_cast<size_t>(desk.beauty.width);
    std::copy_n(&from.r[source], width, &frame_.pixels.r[to]);
    std::copy_n(&from.g[source], width, &frame_.pixels.g[to]);
    std::copy_n(&from.b[source], width, &frame_.pixels.b[to]);
  }
}

void LivePicture::keepPickPlanes(const Patch& patch) {
  if (objects_.empty()) return;
  for (int phase = 0; phase < patch.phases(); ++phase) {
    const ExtraPlanes& extras = patch.phase(phase).extras;
    patch.forEachPixel(phase, [&](size_t from, int x, int y) {
      objects_[frame_.at(x, y)] = extras.object[from];
      depth_[frame_.at(x, y)] = extras.depth[from];
    });
  }
}

void LivePicture::frameDone() {
  if (rested_) film_->frameDone();
}

void LivePicture::image(RgbImage& out) const {
  if (!rested_) {
    out = frame_;
    return;
  }
  film_->mean(out);
  if (view_ == PictureView::error) paintError(*film_, out);
}

double LivePicture::relativeError() const {
  return rested_ ? film_->relativeError() : std::numeric_limits<double>::infinity();
}

}  // namespace ninefold
