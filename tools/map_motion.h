// map_motion.h: the rolling pool in motion: frames of which each has one unit shot anew, with the
// lamp where it is in that frame. Random numbers stay, as in motion everywhere.
//
//   still, circle   The pool has gone on for P = total/per-frame frames before frame 0: nothing is
//                   left of its beginning. Each n-th frame is measured. L: luminance, T: that of
//                   the truth of the moment.
//     variance       mean over pixels of Var_i L / m^2         m: mean luminance of T
//     errorVariance  the same of L - T: what is left when the truth itself moves
//     flicker        mean of (e_i - e_{i-1})^2 / (2 m^2), e = L - T: as `errorVariance` for noise
//                    that is new in each frame; slow errors, as the lag's, do not count
//     relMse         of each frame against its truth, image/metrics.h
//   jump            All of the pool is shot with the lamp behind the boxes; then it stands behind
//                   the camera. response[k]: (m_k - m_0)/(m_P - m_0), m_k: mean luminance after k
//                   units, mean over some runs of unlike seeds. lag: least k with response >= 0.95;
//                   theory: each unit brings 1/P of the change, 0.95 P rounded up.
//
// Threads: one thread's.   Errors: as Renderer.
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "common/image/metrics.h"
#include "tools/map_box.h"
#include "tools/map_truth.h"

namespace ninefold {

inline double meanLuminance(const RgbImage& image) {
  double sum = 0;
  for (size_t i = 0; i < image.count(); ++i) sum += double{luminance(image.rgb(i))};
  return sum / static_cast<double>(image.count());
}

// Mean and variance over time of one value a pixel, and of its steps.
class OverTime {
 public:
  void add(const std::vector<double>& values) {
    mean_.resize(values.size()), squares_.resize(values.size());
    ++count_;
    for (size_t i = 0; i < values.size(); ++i) {
      const double off = values[i] - mean_[i];
      mean_[i] += off / count_;
      squares_[i] += off * (values[i] - mean_[i]);
      if (!last_.empty()) steps_ += (values[i] - last_[i]) * (values[i] - last_[i]);
    }
    last_ = values;
  }
  // Means over pixels.
  double variance() const {
    double sum = 0;
    for (const double s : squares_) sum += s;
    return sum / (count_ - 1) / static_cast<double>(squares_.size());
  }
  double halfSquaredStep() const {
    return steps_ / (2 * (count_ - 1)) / static_cast<double>(squares_.size());
  }

 private:
  std::vector<double> mean_, squares_, last_;
  double count_ = 0, steps_ = 0;
};

struct Fluctuation {
  double variance = 0, errorVariance = 0, flicker = 0;
  std::vector<double> relMse;
};

class MapMotion {
 public:
  // Told of each measured frame and its truth.
  using Seen = std::function<void(int frame, const RgbImage& picture, const RgbImage& truth)>;

  // settings.jitter: off, as in motion everywhere.
  MapMotion(const Scene& scene, const Settings& settings, const MapTruth& truth)
      : scene_(scene), settings_(settings), truth_(truth) {}

  // `frames` of them, each `every`-th. moves: the lamp of the box goes round.
  Fluctuation fluctuation(int frames, int every, bool moves, const Seen& seen) const {
    const auto place = [&](int i) { return moves ? std::optional(lampOnCircle(i)) : std::nullopt; };
    const int parts = settings_.mapPhotons / settings_.mapPerFrame;
    auto moment = std::make_unique<Moment>(scene_, place(-parts), settings_);
    StatePages pages = moment->whole();
    auto unit = static_cast<uint32_t>(parts);
    Fluctuation found;
    OverTime light, error;
    double meanOfTruth = 0;
    RgbImage truth;
    for (int i = 1 - parts; i <= (frames - 1) * every; ++i, ++unit) {
      if (moves) moment = std::make_unique<Moment>(scene_, place(i), settings_);
      moment->step(pages, unit);
      if (i < 0 || i % every != 0) continue;
      const RgbImage picture = moment->picture(pages);
      if (moves || i == 0) truth = truth_.at(i, place(i));
      meanOfTruth += meanLuminance(truth) / frames;
      found.relMse.push_back(compareImages(picture, truth).relMse);
      light.add(luminances(picture, nullptr)), error.add(luminances(picture, &truth));
      seen(i, picture, truth);
    }
    const double unitOfLight = 1 / (meanOfTruth * meanOfTruth);
    found.variance = unitOfLight * light.variance();
    found.errorVariance = unitOfLight * error.variance();
    found.flicker = unitOfLight * error.halfSquaredStep();
    return found;
  }

  // response[0 ... P].
  std::vector<double> response(int runs) const {
    const int parts = settings_.mapPhotons / settings_.mapPerFrame;
    std::vector<double> means(static_cast<size_t>(parts) + 1);
    for (int run = 0; run < runs; ++run) {
      Settings s = settings_;
      s.seed += static_cast<uint64_t>(run);
      const Moment before(scene_, lampOnCircle(3 * kTurn / 4), s);
      const Moment after(scene_, lampOnCircle(kTurn / 4), s);
      StatePages pages = before.whole();
      means[0] += meanLuminance(before.picture(pages));
      for (size_t k = 1; k < means.size(); ++k) {
        after.step(pages, static_cast<uint32_t>(means.size() - 2 + k));
        means[k] += meanLuminance(after.picture(pages));
      }
    }
    std::vector<double> response;
    for (const double m : means)
      response.push_back((m - means.front()) / (means.back() - means.front()));
    return response;
  }

 private:
  // Of each pixel, less those of `truth` if there is one.
  static std::vector<double> luminances(const RgbImage& picture, const RgbImage* truth) {
    std::vector<double> values(picture.count());
    for (size_t i = 0; i < values.size(); ++i)
      values[i] = double{luminance(picture.rgb(i))} -
                  (truth != nullptr ? double{luminance(truth->rgb(i))} : 0.0);
    return values;
  }

  const Scene& scene_;
  Settings settings_;
  const MapTruth& truth_;
};

// Frames until so much of a change is there; one more than all if it never is.
inline size_t lagOf(const std::vector<double>& response, double share = 0.95) {
  return static_cast<size_t>(
      std::find_if(response.begin(), response.end(), [&](double r) { return r >= share; }) -
      response.begin());
}

}  // namespace ninefold
