#include "common/scene/method_trial.h"

#include <cstring>

#include "common/base/error.h"

namespace ninefold {
namespace {

constexpr size_t kHead = 2 + 2 * kTried.size();  // numbers before the pixels

}  // namespace

PageDelta toRecords(uint32_t unit, const TrialUnit& seen) {
  std::vector<float> numbers{seen.sets, seen.pixels};
  for (const TrialUnit::Side& side : seen.sides) {
    numbers.push_back(side.setRays);
    numbers.push_back(side.pixelRays);
  }
  for (const TrialUnit::Side& side : seen.sides)
    numbers.insert(numbers.end(), side.radiance.begin(), side.radiance.end());
  Records bytes(numbers.size() * sizeof(float));
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return {{0, unit}, std::move(bytes)};
}

TrialUnit fromRecords(const Page& page) {
  const auto* bytes = std::get_if<Records>(&page);
  if (bytes == nullptr || bytes->size() % sizeof(float) != 0) fail("no record of a trial");
  std::vector<float> numbers(bytes->size() / sizeof(float));
  std::memcpy(numbers.data(), bytes->data(), bytes->size());
  if (numbers.size() < kHead || (numbers.size() - kHead) % kTried.size() != 0)
    fail("a record of a trial has {} numbers", numbers.size());
  TrialUnit seen;
  seen.sets = numbers[0], seen.pixels = numbers[1];
  const auto pixels = static_cast<ptrdiff_t>((numbers.size() - kHead) / kTried.size());
  auto next = numbers.begin() + kHead;
  for (size_t i = 0; i < kTried.size(); ++i) {
    TrialUnit::Side& side = seen.sides[i];
    side.setRays = numbers[2 + 2 * i], side.pixelRays = numbers[3 + 2 * i];
    side.radiance.assign(next, next + pixels);
    next += pixels;
  }
  return seen;
}

std::string describeTrial(const StatePages&) { return {}; }

}  // namespace ninefold
