// replications.h: means of quantities that frames see, kept apart for eight replications. The
// spread of the replications tells the error of the mean.
//
// Frames f, f + 8, f + 16, ... continue one point sequence in each pixel (sampling/sampler.h). They
// are not independent; their mean is better than if they were. The eight sequences are independent:
//
//   squared standard error of m   =   R/(R-1) sum_r (c_r/N)^2 (m_r - m)^2
//
//   c_r, m_r   number of frames and mean of replication r
//   N, m       number of frames and mean of all: sum c_r, sum c_r m_r / N
//   R          min(N, 8)
//
// The film counts its own frames: they must come in order and without gaps, but may begin with any.
// Below nine frames the formula is s^2/N, s: standard deviation of the frames. Equal frames have an
// error of exactly 0.
//
// Source:  Kollig and Keller, "Efficient Multidimensional Sampling", 2002 (replications of
//          randomized points).
// Proved:  tests/image (closed forms), tests/nightly (Student's t with seven degrees of freedom).
// Threads: add for disjoint quantities at once, else one at a time.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "common/sampling/sampler.h"

namespace ninefold {

// How many of the first `frames` frames replication r has.
inline double framesOf(size_t r, int64_t frames) {
  const int64_t whole = (frames - static_cast<int64_t>(r) + kReplications - 1) / kReplications;
  return static_cast<double>(whole);
}

struct Estimate {
  double mean = 0, squaredError = 0;
};

// Of a quantity whose mean in replication r is at(r), after frames 0 ... frames - 1; at least two.
template <typename At>
Estimate estimateOf(const At& at, int64_t frames) {
  const auto used = static_cast<size_t>(std::min<int64_t>(frames, kReplications));
  Estimate e;
  double weight = 0, sum = 0;
  for (size_t r = 0; r < used; ++r) {
    const double c = framesOf(r, frames);
    weight += c;
    e.mean += c / weight * (at(r) - e.mean);
  }
  for (size_t r = 0; r < used; ++r) {
    const double off = framesOf(r, frames) / weight * (at(r) - e.mean);
    sum += off * off;
  }
  e.squaredError = sum * static_cast<double>(used) / static_cast<double>(used - 1);
  return e;
}

template <typename T>
class Replications {
 public:
  void resize(size_t quantities) {
    quantities_ = quantities, mean_.assign(quantities * kReplications, T(0));
  }
  bool empty() const { return quantities_ == 0; }

  // `values`: quantities first, first + 1, ... as frame number `frame`, from 0, saw them.
  void add(std::span<const T> values, size_t first, int64_t frame) {
    const int64_t before = frame / kReplications;
    const T share = T(1) / static_cast<T>(before + 1);
    T* m = mean_.data() + static_cast<size_t>(frame % kReplications) * quantities_ + first;
    const T* x = values.data();
    const size_t n = values.size();
#pragma GCC ivdep
    for (size_t i = 0; i < n; ++i) m[i] += (x[i] - m[i]) * share;
  }

  // All that add has left, as visit(span).
  template <typename Self, typename Visit>
  static void visitKept(Self& self, Visit& visit) {
    visit(std::span(self.mean_));
  }

  // Mean of quantity i in replication r.
  double at(size_t r, size_t i) const { return static_cast<double>(mean_[r * quantities_ + i]); }

  // Of quantity i after frames 0 ... frames - 1; at least two.
  Estimate estimate(size_t i, int64_t frames) const {
    return estimateOf([&](size_t r) { return at(r, i); }, frames);
  }

 private:
  size_t quantities_ = 0;
  std::vector<T> mean_;  // replication by replication
};

// Of x + a y, for quantity i of both.
template <typename T>
Estimate estimateSum(const Replications<T>& x, double a, const Replications<T>& y, size_t i,
                     int64_t frames) {
  return estimateOf([&](size_t r) { return x.at(r, i) + a * y.at(r, i); }, frames);
}

}  // namespace ninefold
