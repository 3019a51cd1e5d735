#include "common/base/command_line.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>

namespace ninefold {
namespace {

// All of `text` as a number, or nothing.
template <typename T>
std::optional<T> number(std::string_view text) {
  T value{};
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
  if (parsed.ec != std::errc{} || parsed.ptr != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

std::optional<std::string> processVariable(const std::string& name) {
  const char* value = std::getenv(name.c_str());
  return value == nullptr ? std::nullopt : std::optional<std::string>(value);
}

std::string variableOfFlag(std::string_view flag) {
  std::string name = "NINEFOLD_";
  for (const char c : flag)
    name += c == '-' ? '_' : static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return name;
}

std::pair<int, int> parsePair(std::string_view flag, std::string_view text, int low, int high) {
  const size_t x = text.find('x');
  const auto first = number<int>(text.substr(0, x));
  const auto second = number<int>(x == std::string_view::npos ? "" : text.substr(x + 1));
  if (!first || !second || *first < low || *first > high || *second < low || *second > high)
    failUsage("--{} {}: write two numbers of {} to {} with an x between them", flag, text, low,
              high);
  return {*first, *second};
}

std::vector<double> parseNumbers(std::string_view flag, std::string_view text, char between) {
  std::vector<double> numbers;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find(between, begin), text.size());
    const auto value = number<double>(text.substr(begin, end - begin));
    if (!value || !std::isfinite(*value))
      failUsage("--{} {}: write numbers with {} between them", flag, text,
                between == ',' ? "commas" : "colons");
    numbers.push_back(*value);
    begin = end + 1;
  }
  return numbers;
}

uint64_t parseWhole(std::string_view flag, std::string_view text, uint64_t low, uint64_t high) {
  const auto value = number<uint64_t>(text);
  if (!value || *value < low || *value > high)
    failUsage("--{} {}: must be a whole number of {} to {}", flag, text, low, high);
  return *value;
}

}  // namespace ninefold
