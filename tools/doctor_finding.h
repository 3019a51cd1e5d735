// doctor_finding.h: what ninefold-doctor has looked at: one line each.
//
//   ok    round trip   0.21 ms
//   note  window       no display here; ninefold-master --window needs one, a client does not
//   BAD   key          the master does not accept our key: use the master's --key-file
//
// Threads: pure.   Errors: none.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

namespace ninefold {

// note: a client can join, but look at it. bad: it cannot. skipped: could not be looked at.
enum class Grade { good, note, bad, skipped };

struct Finding {
  Grade grade = Grade::good;
  std::string what, found;
  std::string todo = {};  // what to do about it
};

using Findings = std::vector<Finding>;

inline std::string lineOf(const Finding& f) {
  constexpr const char* kGrades[] = {"ok", "note", "BAD", "-"};
  const std::string rest = f.todo.empty() ? f.found : f.found + "; " + f.todo;
  return fmt::format("{:<5} {:<16} {}\n", kGrades[static_cast<size_t>(f.grade)], f.what, rest);
}

inline bool isBad(const Finding& f) { return f.grade == Grade::bad; }

}  // namespace ninefold
