// picture_kept.cpp: a picture's film as bytes and back.
#include <cmath>
#include <type_traits>

#include "common/base/error.h"
#include "master/assembly/picture.h"

namespace ninefold {
namespace {

struct Count {
  size_t bytes = 0;
  template <typename T>
  void operator()(std::span<T> values) {
    bytes += values.size_bytes();
  }
};

struct Keep {
  ByteWriter out;
  template <typename T>
  void operator()(std::span<T> values) {
    out.raw(values.data(), values.size_bytes());
  }
};

// What is not finite would spoil all frames to come.
struct Restore {
  ByteReader in;
  template <typename T>
  void operator()(std::span<T> values) {
    in.raw(values.data(), values.size_bytes(), "the film");
    for (const T& value : values) check(value);
  }
  template <typename T>
  static void check(const T& value) {
    if constexpr (std::is_floating_point_v<T>)
      if (!std::isfinite(value)) fail("the film has values that are not finite");
  }
  static void check(const GuideFilm::Pixel& pixel) {
    check(pixel.albedo), check(pixel.nearness);
    for (int c = 0; c < 3; ++c) check(pixel.normal[c]);
  }
};

}  // namespace

template <typename Self, typename Visit>
void PictureMaker::visitKept(Self& self, Visit& visit) {
  Film::visitKept(self.film_, visit);
  if (self.aovs_) AovFilm::visitKept(*self.aovs_, visit);
  if (self.guides_) GuideFilm::visitKept(*self.guides_, visit);
}

void PictureMaker::keep(Bytes& out) const {
  out.reserve(keptBytes());
  Keep keep{ByteWriter(out)};
  visitKept(*this, keep);
}

size_t PictureMaker::keptBytes() const {
  Count count;
  visitKept(*this, count);
  return count.bytes + film_.mostBiasBytes();
}

void PictureMaker::restore(ByteView kept, int64_t frames) {
  Restore restore{ByteReader(kept, "the film")};
  visitKept(*this, restore);
  restore.in.expectEnd();
  const bool isOne = film_.frames() == frames && (!aovs_ || aovs_->frames() == frames) &&
                     (!guides_ || guides_->frames() == frames);
  if (!isOne) fail("the film has {} frames, {} are declared", film_.frames(), frames);
}

}  // namespace ninefold
