#include "master/output/progress.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace ninefold {
namespace {

constexpr int kBarCells = 30;
constexpr double kEnoughToGuess = 0.01;  // of the work, before an end is foretold

int percent(const ProgressState& state) {
  return static_cast<int>(100 * std::clamp(state.fraction, 0.0, 1.0));
}

std::string time(double seconds) {
  seconds = std::max(0.0, seconds - 1e-3);  // rounding makes no second
  if (seconds < 100) return fmt::format("{:.0f} s", std::ceil(seconds));
  if (seconds < 6000) return fmt::format("{:.0f} min", std::ceil(seconds / 60));
  return fmt::format("{:.0f} h", std::ceil(seconds / 3600));
}

}  // namespace

std::string Progress::describe(const ProgressState& state, Time now) const {
  std::string text = fmt::format("{}% frame {}", percent(state), state.frames);
  if (state.of) text += fmt::format(" of {}", *state.of);
  const double elapsed = seconds(now - start_);
  if (state.fraction >= 1)
    text += " after " + time(elapsed);
  else if (const double own = state.fraction - state.before; own >= kEnoughToGuess)
    text +=
        " eta " + time(seconds(now - state.begun.value_or(start_)) * (1 - state.fraction) / own);
  if (!state.note.empty()) text += ", " + state.note;
  return text;
}

std::string Progress::draw(const ProgressState& state, Time now) const {
  if (!terminal_) return "progress: " + describe(state, now) + "\n";
  const auto full = static_cast<size_t>(kBarCells * percent(state) / 100);
  const std::string bar = std::string(full, '#') + std::string(kBarCells - full, '.');
  return fmt::format("\r[{}] {}\x1b[K", bar,
                     describe(state, now));  // ... and clears what is behind
}

std::optional<std::string> Progress::update(const ProgressState& state, Time now) {
  if (printed_ && now - *printed_ < (terminal_ ? kRedraw : kLine)) return std::nullopt;
  std::string text = draw(state, now);
  if (text == last_) return std::nullopt;
  printed_ = now;
  last_ = text;
  return text;
}

std::string Progress::finish(const ProgressState& state, Time now) {
  return draw(state, now) + (terminal_ ? "\n" : "");
}

}  // namespace ninefold
