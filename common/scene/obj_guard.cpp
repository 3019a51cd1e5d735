#include "common/scene/obj_guard.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "common/base/error.h"
#include "common/scene/reader.h"

namespace ninefold {
namespace {

constexpr std::string_view kBlanks = " \t\r";

// Cuts the next word off `line`; empty at its end.
std::string_view nextWord(std::string_view& line) {
  const size_t begin = std::min(line.find_first_not_of(kBlanks), line.size());
  line.remove_prefix(begin);
  const size_t length = std::min(line.find_first_of(kBlanks), line.size());
  const std::string_view word = line.substr(0, length);
  line.remove_prefix(length);
  return word;
}

std::string_view trimmed(std::string_view text) {
  const size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) + 1 - begin);
}

// A number that is finite in single precision; what is too small for it counts as 0.
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

class Checker {
 public:
  void line(std::string_view line);
  ObjOutline outline;

 private:
  DVec3 numbers(std::string_view rest, int least, const char* what);  // the first three
  void face(std::string_view rest);
  void corner(std::string_view word);
  void index(std::string_view digits, int64_t count, const char* what);

  int64_t normals_ = 0, coordinates_ = 0;
  uint64_t triangles_ = 0;
  uint64_t number_ = 0;  // of the line
};

void Checker::line(std::string_view text) {
  ++number_;
  const std::string_view keyword = nextWord(text);
  if (keyword == "v") outline.positions.push_back(numbers(text, 3, "a position"));
  if (keyword == "vn") numbers(text, 3, "a normal"), ++normals_;
  if (keyword == "vt") numbers(text, 1, "a texture coordinate"), ++coordinates_;
  if (keyword == "f") face(text);
  if (keyword == "mtllib") outline.libraries.emplace_back(trimmed(text));
}

DVec3 Checker::numbers(std::string_view rest, int least, const char* what) {
  DVec3 first(0);
  int count = 0;
  for (std::string_view word = nextWord(rest); !word.empty(); word = nextWord(rest), ++count) {
    if (word[0] == '#') break;
    const auto number = finiteNumber(word);
    if (!number)
      fail("line {}: '{}' of {} is not a finite number: export the scene again", number_,
           word.substr(0, 40), what);
    if (count < 3) first[count] = *number;
  }
  if (count < least) fail("line {}: {} needs {} numbers, it has {}", number_, what, least, count);
  return first;
}

void Checker::face(std::string_view rest) {
  size_t corners = 0;
  for (std::string_view word = nextWord(rest); !word.empty(); word = nextWord(rest), ++corners)
    corner(word);
  if (corners < 3 || corners > kMaxCorners)
    fail("line {}: a face of {} corners, 3 to {} are supported: triangulate it", number_, corners,
         kMaxCorners);
  triangles_ += corners - 2;
  if (triangles_ > kMaxTriangles) fail("more than {} triangles: simplify the scene", kMaxTriangles);
}

// v, v/vt, v//vn or v/vt/vn; an empty part is absent.
void Checker::corner(std::string_view word) {
  const size_t first = std::min(word.find('/'), word.size());
  index(word.substr(0, first), static_cast<int64_t>(outline.positions.size()), "position");
  if (first == word.size()) return;
  std::string_view rest = word.substr(first + 1);
  const size_t second = std::min(rest.find('/'), rest.size());
  if (second > 0) index(rest.substr(0, second), coordinates_, "texture coordinate");
  if (second == rest.size()) return;
  rest.remove_prefix(second + 1);
  if (!rest.empty()) index(rest, normals_, "normal");
}

void Checker::index(std::string_view digits, int64_t count, const char* what) {
  int64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size())
    fail("line {}: '{}' is no index of a {}", number_, digits.substr(0, 40), what);
  if (value == 0 || value > count || value < -count)
    fail("line {}: {} index {} is out of range, {} are defined before it", number_, what, value,
         count);
}

}  // namespace

ObjOutline checkObj(std::string_view text) {
  if (text.find('\0') != std::string_view::npos) fail("not an OBJ file: it has zero bytes");
  Checker checker;
  while (!text.empty()) {
    const size_t end = std::min(text.find_first_of("\n\r"), text.size());
    checker.line(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (text.starts_with('\n') && text.data()[-1] == '\r') text.remove_prefix(1);
  }
  return std::move(checker.outline);
}

}  // namespace ninefold
