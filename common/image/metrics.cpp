#include "common/image/metrics.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "common/base/error.h"
#include "common/image/ssim.h"

namespace ninefold {
namespace {

constexpr double kTrimmedShare = 0.001;
constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

double square(double v) { return v * v; }
double over(double a, double b) { return b != 0 ? a / b : kNoValue; }

double meanOf(const std::vector<double>& values, size_t count) {
  double sum = 0;
  for (size_t i = 0; i < count; ++i) sum += values[i];
  return count > 0 ? sum / static_cast<double>(count) : kNoValue;
}

// Counts pixels that are not finite, and blackens them in both images.
void dropNonFinite(RgbImage& image, RgbImage& reference, std::vector<size_t>& kept,
                   Metrics& metrics) {
  for (size_t i = 0; i < image.count(); ++i) {
    const bool imageBad = !isFinite(image.rgb(i)), referenceBad = !isFinite(reference.rgb(i));
    metrics.nonFiniteImage += imageBad;
    metrics.nonFiniteReference += referenceBad;
    if (!imageBad && !referenceBad) {
      kept.push_back(i);
      continue;
    }
    for (RgbPlane* p : {&image.pixels, &reference.pixels}) p->r[i] = p->g[i] = p->b[i] = 0;
  }
}

// Sums over the kept pixels, per channel.
struct Totals {
  DVec3 image{0}, reference{0}, squaredDifference{0};
  double luminance = 0;  // of the reference
};

Totals totalsOf(const RgbImage& image, const RgbImage& reference, const std::vector<size_t>& kept) {
  Totals t;
  for (const size_t i : kept) {
    const DVec3 x(image.rgb(i)), r(reference.rgb(i));
    t.image += x, t.reference += r, t.squaredDifference += (x - r) * (x - r);
    t.luminance += static_cast<double>(luminance(reference.rgb(i)));
  }
  return t;
}

double sumOf(DVec3 v) { return v.x + v.y + v.z; }

// The relMse terms of the kept pixels, each the mean over channels.
std::vector<double> relativeTerms(const RgbImage& image, const RgbImage& reference,
                                  const std::vector<size_t>& kept, double meanLuminance) {
  std::vector<double> terms;
  terms.reserve(kept.size());
  for (const size_t i : kept) {
    const DVec3 x = DVec3(image.rgb(i)) / meanLuminance;
    const DVec3 r = DVec3(reference.rgb(i)) / meanLuminance;
    double sum = 0;
    for (int c = 0; c < 3; ++c) sum += square(x[c] - r[c]) / (square(r[c]) + 0.01);
    terms.push_back(sum / 3);
  }
  return terms;
}

WorstPixel worstOf(const RgbImage& image, const RgbImage& reference,
                   const std::vector<size_t>& kept, const std::vector<double>& terms) {
  const auto at = std::max_element(terms.begin(), terms.end());
  const size_t i = kept[static_cast<size_t>(at - terms.begin())];
  const size_t width = static_cast<size_t>(image.width);
  return {static_cast<int>(i % width), static_cast<int>(i / width), image.rgb(i), reference.rgb(i),
          *at};
}

void setRelative(const RgbImage& image, const RgbImage& reference, const std::vector<size_t>& kept,
                 double meanLuminance, Metrics& metrics) {
  std::vector<double> terms = relativeTerms(image, reference, kept, meanLuminance);
  metrics.worst = worstOf(image, reference, kept, terms);
  metrics.relMse = meanOf(terms, terms.size());
  std::sort(terms.begin(), terms.end());
  const size_t trimmed = static_cast<size_t>(kTrimmedShare * static_cast<double>(terms.size()));
  metrics.relMseTrimmed = meanOf(terms, terms.size() - trimmed);
  metrics.ssim = structuralSimilarity(image, reference, meanLuminance);
}

}  // namespace

Metrics compareImages(const RgbImage& imageAsGiven, const RgbImage& referenceAsGiven) {
  RgbImage image = imageAsGiven, reference = referenceAsGiven;
  if (image.width != reference.width || image.height != reference.height)
    fail("the image has {}x{} pixels and the reference {}x{}; compare images of one size",
         image.width, image.height, reference.width, reference.height);
  Metrics metrics;
  std::vector<size_t> kept;
  dropNonFinite(image, reference, kept, metrics);
  const Totals totals = totalsOf(image, reference, kept);
  const double values = 3.0 * static_cast<double>(kept.size());
  metrics.rmse = std::sqrt(over(sumOf(totals.squaredDifference), values));
  metrics.rmsePercent = 100 * over(metrics.rmse, over(sumOf(totals.reference), values));
  for (int c = 0; c < 3; ++c)
    metrics.bias[c] = over(totals.image[c] - totals.reference[c], totals.reference[c]);
  metrics.relMse = metrics.relMseTrimmed = metrics.ssim = metrics.worst.relMse = kNoValue;
  if (totals.luminance > 0)
    setRelative(image, reference, kept, totals.luminance / static_cast<double>(kept.size()),
                metrics);
  return metrics;
}

}  // namespace ninefold
