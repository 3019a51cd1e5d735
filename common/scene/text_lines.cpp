#include "common/scene/text_lines.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "common/base/error.h"

namespace ninefold {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

bool isBlank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

bool isUtf16(std::string_view text) {
  return text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF");
}

}  // namespace

TextLines::TextLines(std::string_view text) : rest_(text) {
  if (isUtf16(text)) fail("the file is UTF-16 text: save it as UTF-8");
  if (text.find('\0') != std::string_view::npos)
    fail("not a text file: it has zero bytes; if it is UTF-16, save it as UTF-8");
}

std::string_view TextLines::physicalLine() {
  ++read_;
  const auto isEnd = [](char c) { return c == '\n' || c == '\r'; };
  const auto length =
      static_cast<size_t>(std::find_if(rest_.begin(), rest_.end(), isEnd) - rest_.begin());
  std::string_view line = rest_.substr(0, length);
  const size_t end = rest_.substr(length).starts_with("\r\n") ? 2 : 1;
  rest_.remove_prefix(std::min(length + end, rest_.size()));
  while (line.starts_with(kByteOrderMark)) line.remove_prefix(kByteOrderMark.size());
  return line;
}

bool TextLines::next(std::string_view& line) {
  if (rest_.empty()) return false;
  line = physicalLine();
  number_ = read_;
  if (!line.ends_with('\\') || trimmed(line).starts_with('#')) return true;
  joined_.clear();
  while (line.ends_with('\\')) {
    joined_.append(line.substr(0, line.size() - 1)).push_back(' ');
    line = rest_.empty() ? std::string_view() : physicalLine();
  }
  line = joined_.append(line);
  return true;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
  while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
  return text;
}

std::string_view nextWord(std::string_view& line) {
  const auto begin = std::find_if_not(line.begin(), line.end(), isBlank);
  const auto end = std::find_if(begin, line.end(), isBlank);
  const std::string_view word(begin, end);
  line = std::string_view(end, line.end());
  return word;
}

std::string_view unquoted(std::string_view text) {
  text = trimmed(text);
  const bool quoted = text.size() >= 2 && text.front() == text.back() &&
                      (text.front() == '"' || text.front() == '\'');
  return quoted ? text.substr(1, text.size() - 2) : text;
}

std::string normalizedName(std::string_view text) {
  std::string name;
  text = unquoted(text);
  for (std::string_view word = nextWord(text); !word.empty(); word = nextWord(text))
    name.append(name.empty() ? "" : " ").append(word);
  return name;
}

std::string lowerCase(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c + ('a' - 'A'));
  return lower;
}

std::optional<double> finiteNumber(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size()) return {};
  if (error == std::errc::result_out_of_range) {
    const bool tiny =
        word.find("e-") != std::string_view::npos || word.find("E-") != std::string_view::npos;
    return tiny ? std::optional(0.0) : std::nullopt;
  }
  const bool fits = error == std::errc() && std::abs(value) <= std::numeric_limits<float>::max();
  return fits ? std::optional(value) : std::nullopt;
}

}  // namespace ninefold
