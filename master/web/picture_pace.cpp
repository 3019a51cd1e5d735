#include "master/web/picture_pace.h"

#include <algorithm>

namespace ninefold {

size_t PicturePace::form(int64_t frames) const {
  return frames < kCalm ? std::max<size_t>(form_, 1) : form_;
}

void PicturePace::shown(Time now) {
  const Duration took = now - sentAt_;
  if (took > kSlow) return coarser(took > 2 * kSlow ? 2 : 1);
  fast_ = took < kFast ? fast_ + 1 : 0;
  if (fast_ < needed_ || form_ == 0) return;
  --form_;
  fast_ = 0;
}

void PicturePace::coarser(size_t steps) {
  form_ = std::min(form_ + steps, kPictureForms.size() - 1);
  fast_ = 0;
  needed_ = std::min(4 * needed_, 64);
}

}  // namespace ninefold
