// live_picture.h: what a live session shows: tiles of a frame become a picture, in motion the frame
// itself, at rest the mean of all frames since the rest began.
//
// Threads: finishTile for different tiles and workers at once, all of one frame before the next's;
// everything else between frames. Memory: a film, a frame, and a patch for each worker.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "common/image/film.h"
#include "common/image/patch_filter.h"
#include "master/assembly.h"
#include "master/live_plan.h"
#include "master/view.h"

namespace ninefold {

class LivePicture {
 public:
  LivePicture(SurfaceTest test, int workers, float depthScale);

  // `owners`: by task, the client that it came from.
  void finishTile(int worker, const GatheredFrame& frame, const LiveFrame& plan, PictureView view,
                  const std::vector<uint32_t>& owners, int tile);
  void frameDone();

  void image(RgbImage& out) const;  // of the frames that are done
  // As kObjectPlane and kDepthPlane, if the last frame carried both; else empty.
  const std::vector<uint32_t>& objects() const { return objects_; }
  const std::vector<float>& depth() const { return depth_; }
  int64_t frames() const { return rested_ ? film_->frames() : 1; }
  double relativeError() const;

 private:
  struct Desk {  // of one worker
    explicit Desk(SurfaceTest test) : filter(test) {}
    Patch patch;
    PatchFilter filter;
    RgbImage beauty;
  };
  void begin(const GatheredFrame& frame, const LiveFrame& plan, PictureView view);
  void keepTile(const Desk& desk);
  void keepPickPlanes(const Patch& patch);

  const float depthScale_;
  std::vector<std::unique_ptr<Desk>> desks_;
  std::mutex begin_;
  std::optional<uint32_t> current_;  // the frame whose tiles come; guarded by begin_
  PictureView view_ = PictureView::beauty;
  bool rested_ = false;
  std::unique_ptr<Film> film_;
  RgbImage frame_;
  std::vector<uint32_t> objects_;
  std::vector<float> depth_;
};

}  // namespace ninefold
