// picture.h: from gathered results to the picture: discontinuity buffer, film, last touch, tone
// map, file.
//
// The image hash is of the film's mean, so it depends on the frames and their order alone.
// Threads: finishTile for different tiles and workers at once; everything else between frames.
// Memory: the film's sums and a patch for each worker; no allocation per frame after the first.
// Errors: write throws Error that names the file.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "common/image/aov_film.h"
#include "common/image/film.h"
#include "common/image/guide_film.h"
#include "common/image/image_file.h"
#include "common/image/patch_filter.h"
#include "master/assembly/assembly.h"
#include "master/assembly/view.h"
#include "proto/bytes.h"

namespace ninefold {

class PictureMaker {
 public:
  struct Setup {
    FrameShape shape;
    FilmKeeps keeps;
    uint8_t aovMask = 0;  // planes that become layers of the file
    PictureView view = PictureView::beauty;
    float depthScale = 1;  // [m], see view.h
    SurfaceTest surfaceTest = SurfaceTest::surface;
    std::optional<float> exposure;  // [EV] of a .png; none: exposureByPicture
    ToneCurve curve = ToneCurve::srgb;
    int workers = 1;
    bool denoise = false;  // what is written, where layers came and the view is light
  };
  explicit PictureMaker(const Setup& setup);

  // Puts a tile of the next frame onto the film. Its results and those around it must be there.
  void finishTile(int worker, const GatheredFrame& frame, int tile);
  void frameDone();  // all tiles of a frame were finished

  int64_t frames() const { return film_.frames(); }
  double relativeError() const { return film_.relativeError(); }
  // The film, and all beside it that the next frames need, as bytes.
  void keep(Bytes& out) const;
  size_t keptBytes() const;  // at most
  // Puts back what another maker of the same setup kept after `frames` frames. Error, in one line:
  // it is not that; then the maker must not be used any more.
  void restore(ByteView kept, int64_t frames);
  bool isDenoised() const { return guides_.has_value(); }  // what is written
  std::string imageHash() const;
  // What is to be written, taken while no worker adds to the film; workers may go on meanwhile.
  struct Copy {
    RgbImage mean;
    std::vector<float> error;  // standard, if the picture is denoised
    DenoiseGuides guides;      // likewise
    std::vector<Channel> extras;
    int64_t frames = 0;
    std::string imageHash;
  };
  Copy copy() const;
  void write(const std::string& path, const Metadata& metadata, const Copy& copy) const;

 private:
  template <typename Self, typename Visit>
  static void visitKept(Self& self, Visit& visit);
  void addFiltered(FilterDesk& desk, const GatheredFrame& frame, int tile);
  std::vector<Channel> extraChannels() const;

  const Setup setup_;
  std::vector<std::unique_ptr<FilterDesk>> desks_;
  Film film_;
  std::optional<AovFilm> aovs_;      // if extra layers are wanted
  std::optional<GuideFilm> guides_;  // if what is written is denoised
};

// Exposure of a picture of light by itself (auto_exposure.h) [EV]. A line in the log says it.
float exposureByPicture(const RgbImage& radiance);

// A tile of the next frame onto the film: unfiltered and filtered, if it keeps both, else beauty.
void addTile(Film& film, const FilterDesk& desk, const TaskRect& rect);

// Fills a patch with a tile of the frame and what lies around it.
void gather(const GatheredFrame& frame, int tile, Patch& patch);

}  // namespace ninefold
