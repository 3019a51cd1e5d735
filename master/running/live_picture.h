// live_picture.h: what a live session shows. Tiles become a picture: in motion the frame itself, at
// rest the mean of all frames since the rest began. A tile is filtered, summed up and tone mapped
// in one go, while it is in the cache.
//
// At rest the light is summed up whatever view is shown, so that it is there when it is looked at
// again. A view that paints something else is summed up beside it, from when it was chosen. After a
// frame's last tile the film finds the neighbours' share for the tiles of the next frames, and now
// and then codes get a last touch. Of a still the last frame has a share of its own.
//
// Threads: finishTile for different tiles and workers at once, all of one frame before the next's;
// everything else between frames.
// Memory: a film, one more for a painted view, a history, a patch for each worker, and one image
// more than are held: an image that nobody holds any more is filled again.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "common/image/irradiance_history.h"
#include "common/image/patch_filter.h"
#include "master/assembly/assembly.h"
#include "master/assembly/rest_film.h"
#include "master/assembly/rest_touch.h"
#include "master/assembly/view.h"
#include "master/running/live_image.h"
#include "master/running/live_plan.h"

namespace ninefold {

// How a frame is to be looked at.
struct LiveLook {
  PictureView view = PictureView::beauty;
  std::optional<float> exposure;  // [EV] of the tone map; none: nobody looks at codes
  FilmKeeps keeps = {};           // of the light at rest; changes at a rest's beginning
  bool denoise = false;  // codes of light at rest get the last touch (rest_touch.h); as keeps
  ToneCurve curve = ToneCurve::srgb;

  Tone tone() const { return {exposure.value_or(0), curve}; }
};

class LivePicture {
 public:
  struct Setup {
    SurfaceTest test = SurfaceTest::surface;
    int workers = 1;
    float depthScale = 1;  // [m], see view.h
    bool reuses = false;   // light of one frame in the next, while only the camera moves
  };
  explicit LivePicture(const Setup& setup);

  // `owners`: by task, the client that it came from.
  void finishTile(int worker, const GatheredFrame& frame, const LiveFrame& plan,
                  const LiveLook& look, const std::vector<uint32_t>& owners, int tile);
  // stop: nobody waits for the last touch any more.
  void frameDone(const std::stop_token& stop = {});

  std::shared_ptr<const LiveImage> image() const { return image_; }  // of the frames that are done
  int64_t frames() const { return rested_ ? shownFilm().film().frames() : 1; }
  double relativeError() const;

 private:
  void begin(const GatheredFrame& frame, const LiveFrame& plan, const LiveLook& look);
  void beginRest(const FrameShape& shape, bool isFirst);
  void addToRest(const FilterDesk& desk, const TaskRect& rect, int tile);
  void touchUp(const std::stop_token& stop);
  void takeImage(const FrameShape& shape, bool isFirst);
  const RestFilm& shownFilm() const { return isPainted(look_.view) ? painted_ : light_; }
  void finishLayers(FilterDesk& desk, const GatheredFrame& frame, bool moving, int tile);
  void paintTile(FilterDesk& desk, const FrameView& view, const std::vector<uint32_t>& owners,
                 int tile);
  void showMean(const TaskRect& tile);
  void showWholeMean();
  void copyTile(const TaskRect& tile, const RgbImage& beauty);
  void toneMap(const TaskRect& tile);
  void keepPickPlanes(const Patch& patch);

  const Setup setup_;
  IrradianceHistory history_;
  uint32_t world_ = 0;   // LiveFrame::world of the frame that history_ has seen
  bool traced_ = false;  // history_ sees the frame: clients have not filtered it
  std::vector<std::unique_ptr<FilterDesk>> desks_;
  std::mutex begin_;
  std::optional<uint32_t> current_;  // the frame whose tiles come; guarded by begin_
  LiveLook look_;
  bool rested_ = false;  // summed up; in a still of codes nothing is
  bool last_ = false;    // LiveFrame::last
  RestFilm light_, painted_;
  bool guided_ = false;  // the frame brings what touch_ is guided by
  RestTouch touch_;
  PictureView paintedView_ = PictureView::beauty;   // of painted_
  std::shared_ptr<PickPlanes> picks_;               // of the frame, or of the first one of the rest
  std::shared_ptr<LiveImage> image_;                // that tiles come into
  std::vector<std::shared_ptr<LiveImage>> images_;  // all that there are
};

}  // namespace ninefold
