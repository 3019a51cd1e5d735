// options_flags.h: which flags ninefold-master has, and their raw values.
// Threads: pure. Errors: UsageError for what is no flag, has no value or is given twice.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "common/base/command_line.h"

namespace ninefold {

// Values as they were written, by flag; a switch that is on has the value "1".
class RawOptions {
 public:
  RawOptions(int argc, const char* const* argv, const Variable& variable);

  bool has(const std::string& flag) const { return values_.contains(flag); }
  std::optional<std::string> text(const std::string& flag) const;
  // A switch; from a variable also "0" or "1".
  bool isOn(const std::string& flag) const;
  // A whole number, or a real one, in [low, high].
  std::optional<int64_t> whole(const std::string& flag, uint64_t low, uint64_t high) const;
  std::optional<double> real(const std::string& flag, double low, double high) const;

 private:
  std::map<std::string, std::string> values_;
};

}  // namespace ninefold
