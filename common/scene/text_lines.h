// text_lines.h: the lines, words and numbers of OBJ and MTL files.
//
// Lines end with \n, \r or both. A backslash as a line's last character continues it, but not in a
// comment: comments may end in a path. A byte order mark (UTF-8) is skipped wherever a line begins:
// files that were put together have several. UTF-16 is refused.
// Owner: refers to the text.   Threads: one.   Errors: throws Error (UTF-16, zero bytes).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ninefold {

class TextLines {
 public:
  explicit TextLines(std::string_view text);

  // False at the end. The line is valid until the next call.
  bool next(std::string_view& line);
  // Number of that line, from 1; of its first part if it is continued.
  uint64_t number() const { return number_; }

 private:
  std::string_view physicalLine();

  std::string_view rest_;
  uint64_t number_ = 0, read_ = 0;
  std::string joined_;  // of a continued line
};

std::string_view trimmed(std::string_view text);

// Cuts the next word off `line`; empty at its end.
std::string_view nextWord(std::string_view& line);

// A name in the form in which names are compared: without quotes, each run of blanks and tabs one
// blank.
std::string normalizedName(std::string_view text);

// `text` without quotes around it.
std::string_view unquoted(std::string_view text);

std::string lowerCase(std::string_view text);

// A number that is finite in single precision; one too small for it counts as 0.
std::optional<double> finiteNumber(std::string_view word);

}  // namespace ninefold
