#include "common/scene/obj_parser.h"

#include <array>
#include <charconv>
#include <cstdint>
#include <vector>

#include "common/base/error.h"
#include "common/scene/reader.h"
#include "common/scene/text_lines.h"
#include "common/scene/unread_keys.h"

namespace ninefold {
namespace {

// ZBrush hides colours of vertices in comments.
constexpr std::string_view kColourComment = "#MRGB";

struct Numbers {
  std::array<double, 7> value{};  // the first ones
  int count = 0;                  // of all
};

class Parser {
 public:
  Parser(std::string_view text, ObjEvents& events) : lines_(text), events_(&events) {}
  void run();

 private:
  void statement(std::string_view keyword, std::string_view rest);
  void vertex(std::string_view rest);
  void colour(Vec3 srgb);
  void face(std::string_view rest);
  ObjCorner corner(std::string_view word) const;
  Numbers numbers(std::string_view rest, int least, const char* what) const;
  int place(std::string_view digits, int64_t count, const char* what) const;

  TextLines lines_;
  ObjEvents* events_;
  int64_t positions_ = 0, normals_ = 0, coordinates_ = 0;
  uint64_t triangles_ = 0;
  bool smooth_ = false;  // in a smoothing group
  std::vector<ObjCorner> corners_;
  UnreadKeys unread_;
};

void Parser::run() {
  for (std::string_view line; lines_.next(line);) {
    const std::string_view keyword = nextWord(line);
    if (!keyword.empty() && (keyword[0] != '#' || keyword == kColourComment))
      statement(keyword, line);
  }
  unread_.report("the OBJ file");
}

bool isSmoothing(std::string_view rest) {
  const std::string_view group = nextWord(rest);
  return !group.empty() && group != "0" && group != "off" && group != "null";
}

void Parser::statement(std::string_view keyword, std::string_view rest) {
  if (keyword == "v") {
    vertex(rest);
  } else if (keyword == "vt") {
    const Numbers n = numbers(rest, 1, "a texture coordinate");
    events_->addCoordinate(Vec2(n.value[0], n.value[1])), ++coordinates_;
  } else if (keyword == "vn") {
    const Numbers n = numbers(rest, 3, "a normal");
    events_->addNormal(Vec3(n.value[0], n.value[1], n.value[2])), ++normals_;
  } else if (keyword == "f") {
    face(rest);
  } else if (keyword == "g" || keyword == "o") {
    events_->startGroup(normalizedName(rest));
  } else if (keyword == "usemtl") {
    events_->useMaterial(normalizedName(rest));
  } else if (keyword == "mtllib") {
    events_->addLibraries(trimmed(rest));
  } else if (keyword == "s") {
    smooth_ = isSmoothing(rest);
  } else {
    unread_.add(keyword, lines_.number());
  }
}

void Parser::vertex(std::string_view rest) {
  const auto [v, count] = numbers(rest, 3, "a position");
  events_->addPosition(DVec3(v[0], v[1], v[2])), ++positions_;
  if (count == 3 || (count == 4 && v[3] == 1)) return;
  if (count == 6 || count == 7) colour(Vec3(v[3], v[4], v[5]));
  if (count == 6 || (count == 7 && v[6] == 1)) return;
  unread_.add(count == 7   ? "opacity of v"
              : count == 4 ? "weight of v"
                           : "further numbers of v",
              lines_.number());
}

void Parser::colour(Vec3 srgb) {
  events_->colourPosition(srgb);
  if (srgb != glm::clamp(srgb, 0.0f, 1.0f))
    unread_.add("colours of v beyond 0 to 1", lines_.number());
}

Numbers Parser::numbers(std::string_view rest, int least, const char* what) const {
  Numbers n;
  for (std::string_view word = nextWord(rest); !word.empty(); word = nextWord(rest), ++n.count) {
    if (word[0] == '#') break;
    const auto number = finiteNumber(word);
    if (!number)
      fail("line {}: '{}' of {} is not a finite number: export the scene again", lines_.number(),
           word.substr(0, 40), what);
    if (static_cast<size_t>(n.count) < n.value.size())
      n.value[static_cast<size_t>(n.count)] = *number;
  }
  if (n.count < least)
    fail("line {}: {} needs {} numbers, it has {}", lines_.number(), what, least, n.count);
  return n;
}

void Parser::face(std::string_view rest) {
  corners_.clear();
  bool hasNormals = true;
  for (std::string_view word = nextWord(rest); !word.empty(); word = nextWord(rest)) {
    if (word[0] == '#') break;
    corners_.push_back(corner(word));
    hasNormals &= corners_.back().normal >= 0;
  }
  if (corners_.size() < 3 || corners_.size() > kMaxCorners)
    fail("line {}: a face of {} corners, 3 to {} are supported: triangulate it", lines_.number(),
         corners_.size(), kMaxCorners);
  triangles_ += corners_.size() - 2;
  if (triangles_ > kMaxTriangles) fail("more than {} triangles: simplify the scene", kMaxTriangles);
  if (smooth_ && !hasNormals) unread_.add("s without normals", lines_.number());
  events_->addFace(corners_);
}

// v, v/vt, v//vn or v/vt/vn; an empty part is absent.
ObjCorner Parser::corner(std::string_view word) const {
  ObjCorner corner;
  const size_t first = std::min(word.find('/'), word.size());
  corner.position = place(word.substr(0, first), positions_, "position");
  if (first == word.size()) return corner;
  std::string_view rest = word.substr(first + 1);
  const size_t second = std::min(rest.find('/'), rest.size());
  if (second > 0)
    corner.coordinate = place(rest.substr(0, second), coordinates_, "texture coordinate");
  if (second == rest.size()) return corner;
  rest.remove_prefix(second + 1);
  if (!rest.empty()) corner.normal = place(rest, normals_, "normal");
  return corner;
}

int Parser::place(std::string_view digits, int64_t count, const char* what) const {
  int64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size())
    fail("line {}: '{}' is no index of a {}", lines_.number(), digits.substr(0, 40), what);
  if (value == 0 || value > count || value < -count)
    fail("line {}: {} index {} is out of range, {} are defined before it", lines_.number(), what,
         value, count);
  return static_cast<int>(value > 0 ? value - 1 : count + value);
}

}  // namespace

void parseObj(std::string_view text, ObjEvents& events) { Parser(text, events).run(); }

}  // namespace ninefold
