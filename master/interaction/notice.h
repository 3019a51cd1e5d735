// notice.h: what the window tells a person for a few seconds, such as where a file went. The log
// gets the same.
// Threads: one owner. Errors: none.
#pragma once

#include <optional>
#include <string>

#include "common/base/clock.h"
#include "common/base/log.h"

namespace ninefold {

class Notice {
 public:
  static constexpr Duration kShown = std::chrono::seconds(6);

  void say(const std::string& text) {
    log("{}", text);
    show(text);
  }
  void complain(const std::string& text) {
    warn("{}", text);
    show(text);
  }
  std::optional<std::string> text(Time now) const {
    return now < until_ ? std::optional(text_) : std::nullopt;
  }

 private:
  void show(const std::string& text) {
    text_ = text;
    until_ = Clock::now() + kShown;
  }
  std::string text_;
  Time until_{};
};

}  // namespace ninefold
