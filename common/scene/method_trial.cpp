#include "common/scene/method_trial.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "common/base/error.h"
#include "common/scene/methods.h"

namespace ninefold {
namespace {

constexpr size_t kHead = 2 + 2 * kTried.size();  // numbers before the pixels
constexpr double kSetRay = 2, kPixel = 5;
constexpr double kDark = 0.01, kDarkShare = 1.0 / 32;
constexpr double kBetter = 1.5;
constexpr double kWorst = 0.05;  // of the pixels, left out
// What is as dark as this beside the whole picture is dark by both.
constexpr double kShown = 0.1;

TrialUnit fromRecord(const Page& page) {
  const auto* bytes = std::get_if<Records>(&page);
  if (bytes == nullptr || bytes->size() % sizeof(float) != 0) fail("no record of a trial");
  std::vector<float> numbers(bytes->size() / sizeof(float));
  std::memcpy(numbers.data(), bytes->data(), bytes->size());
  for (float& n : numbers)
    if (!std::isfinite(n)) n = 0;  // as in pictures
  if (numbers.size() < kHead || (numbers.size() - kHead) % kTried.size() != 0)
    fail("a record of a trial has {} numbers", numbers.size());
  TrialUnit seen;
  seen.sets = numbers[0], seen.pixels = numbers[1];
  const auto pixels = static_cast<ptrdiff_t>((numbers.size() - kHead) / kTried.size());
  auto next = numbers.begin() + kHead;
  for (size_t m = 0; m < kTried.size(); ++m) {
    TrialUnit::Side& side = seen.sides[m];
    side.setRays = numbers[2 + 2 * m], side.pixelRays = numbers[3 + 2 * m];
    side.radiance.assign(next, next + pixels);
    next += pixels;
  }
  return seen;
}

// Mean and variance over the units, by pixel.
struct Seen {
  std::vector<double> mean, variance;
};

Seen seenBy(const std::vector<TrialUnit>& units, size_t m) {
  const size_t pixels = units.front().sides[m].radiance.size();
  Seen seen{std::vector<double>(pixels, 0), std::vector<double>(pixels, 0)};
  const auto n = static_cast<double>(units.size());
  for (size_t p = 0; p < pixels; ++p) {
    for (const TrialUnit& unit : units) seen.mean[p] += double{unit.sides[m].radiance[p]} / n;
    for (const TrialUnit& unit : units) {
      const double off = double{unit.sides[m].radiance[p]} - seen.mean[p];
      seen.variance[p] += off * off / std::max(n - 1, 1.0);
    }
  }
  return seen;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

// e.
double errorOf(const Seen& own, const Seen& other, double all) {
  std::vector<double> errors;
  for (size_t p = 0; p < own.mean.size(); ++p) {
    const double both = (own.mean[p] + other.mean[p]) / 2;
    errors.push_back(own.variance[p] / (both * both + 0.01 * all * all));
  }
  std::sort(errors.begin(), errors.end());
  errors.resize(errors.size() - static_cast<size_t>(kWorst * static_cast<double>(errors.size())));
  return mean(errors);
}

// d.
double darkBy(const Seen& own, const Seen& other, double all) {
  size_t dark = 0;
  for (size_t p = 0; p < own.mean.size(); ++p)
    if (other.mean[p] > kShown * all && own.mean[p] < kDark * other.mean[p]) ++dark;
  return static_cast<double>(dark) / static_cast<double>(own.mean.size());
}

double costOf(const std::vector<TrialUnit>& units, size_t m) {
  double cost = 0;
  for (const TrialUnit& unit : units)
    cost += kSetRay * double{unit.sets} * double{unit.sides[m].setRays} +
            double{unit.pixels} * (double{unit.sides[m].pixelRays} + kPixel);
  return cost / static_cast<double>(units.size());
}

bool prefersSecond(const Verdict::Side& first, const Verdict::Side& second) {
  if (std::abs(first.dark - second.dark) > kDarkShare) return first.dark > second.dark;
  return first.error * first.cost > kBetter * second.error * second.cost;
}

}  // namespace

PageDelta toRecord(uint32_t unit, const TrialUnit& seen) {
  std::vector<float> numbers{seen.sets, seen.pixels};
  for (const TrialUnit::Side& side : seen.sides)
    numbers.insert(numbers.end(), {side.setRays, side.pixelRays});
  for (const TrialUnit::Side& side : seen.sides)
    numbers.insert(numbers.end(), side.radiance.begin(), side.radiance.end());
  Records bytes(numbers.size() * sizeof(float));
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return {{0, unit}, std::move(bytes)};
}

Verdict judge(const std::vector<TrialUnit>& units) {
  Verdict verdict;
  if (units.empty() || units.front().sides[0].radiance.empty()) return verdict;
  const std::array seen{seenBy(units, 0), seenBy(units, 1)};
  const double all = (mean(seen[0].mean) + mean(seen[1].mean)) / 2;
  if (!(all > 0)) return verdict;
  for (size_t m = 0; m < kTried.size(); ++m) {
    const Seen &own = seen[m], &other = seen[1 - m];
    verdict.sides[m] = {errorOf(own, other, all), costOf(units, m), darkBy(own, other, all)};
  }
  verdict.chosen = prefersSecond(verdict.sides[0], verdict.sides[1]) ? 1 : 0;
  return verdict;
}

Verdict verdictOf(const StatePages& pages) {
  std::vector<TrialUnit> units;
  for (const auto& [id, page] : pages.all()) {
    units.push_back(fromRecord(*page));
    for (const TrialUnit::Side& side : units.back().sides)
      if (side.radiance.size() != units.front().sides[0].radiance.size())
        fail("records of a trial differ in their pixels");
  }
  return judge(units);
}

std::string describeTrial(const StatePages& pages) {
  const Verdict verdict = verdictOf(pages);
  const Verdict::Side &own = verdict.sides[verdict.chosen],
                      &other = verdict.sides[1 - verdict.chosen];
  const char* name = factsOf(kTried[verdict.chosen]).name;
  const char* otherName = factsOf(kTried[1 - verdict.chosen]).name;
  if (!(own.error > 0 && own.cost > 0))
    return fmt::format("method auto: {}, as the trial saw no difference", name);
  if (other.dark > own.dark + kDarkShare)
    return fmt::format("method auto: {}, as {} finds no light for {:.0f} % of the picture", name,
                       otherName, 100 * other.dark);
  return fmt::format(
      "method auto: {}, as {} has {:.2g} times its squared error at {:.2g} times "
      "its cost a frame",
      name, otherName, other.error / own.error, other.cost / own.cost);
}

}  // namespace ninefold
