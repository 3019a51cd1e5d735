#include "master/picture.h"

namespace ninefold {

PictureMaker::PictureMaker(const Setup& setup)
    : setup_(setup),
      film_(setup.grid.width(), setup.grid.height()),
      aovs_(setup.grid, setup.extraMask) {
  filter_.reset(setup_.grid, setup_.layerMask, setup_.surfaceTest);
}

void PictureMaker::add(const FrameBuffer& frame, float neighbourWeight) {
  filter_.compose(frame, setup_.camera, neighbourWeight, beauty_);
  film_.add(beauty_);
  if (setup_.extraMask != 0) aovs_.add(frame, filter_);
}

std::string PictureMaker::imageHash() const {
  RgbImage mean;
  film_.mean(mean);
  return ninefold::imageHash(mean);
}

std::vector<Channel> PictureMaker::extraChannels() const {
  if (setup_.extraMask == 0) return {};
  std::vector<Channel> channels = aovs_.channels();
  RgbImage error;
  film_.standardError(error);
  channels.push_back({"error.R", std::move(error.pixels.r)});
  channels.push_back({"error.G", std::move(error.pixels.g)});
  channels.push_back({"error.B", std::move(error.pixels.b)});
  return channels;
}

void PictureMaker::write(const std::string& path, const Metadata& metadata) const {
  RgbImage mean;
  film_.mean(mean);
  writeImage(path, {mean, extraChannels(), metadata}, ToneMap(setup_.exposure));
}

}  // namespace ninefold
